// Finds where two arrays differ.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "capture/array.h"

namespace rainref::capture {

/// The first element whose bits differ, by level, row, column, and channel or field.
struct Difference {
  std::string place;  ///< "x 12, y 3, channel 0", "record 4, field radius"; with the level if it is not 0
  std::string a, b;   ///< the two values, in decimal and as bits: "0.25 0x3400"
  std::size_t count;  ///< number of elements that differ, in all levels
  std::size_t of;     ///< number of elements
};

/// Nothing if all bits are equal. The arrays must have the same shape.
std::optional<Difference> first_difference(const Array& a, const Array& b);

/// "rg16f 61x37", "3 records Drop".
std::string shape_text(const Array& array);
/// True if format or record, size and number of levels are equal.
bool same_shape(const Array& a, const Array& b);

/// A 4-byte scalar in decimal and as bits: "0.25 0x3e800000".
std::string scalar_text(const std::byte* at, scene::Scalar scalar);

}  // namespace rainref::capture
