// Compares the uniforms, pictures and records that a port's host gives to a pass with those of the scene.
//
// rainref computes them in double and rounds once. A host may compute in float. A value of k operations then has an error of k 2^-24 of its
// largest term, to first order. Sixteen operations with terms four times as large as the result give 2^-18, and no uniform here needs more.
// A buffer of fewer bits stores such a value as one of its two neighbours.
#pragma once

#include <cstddef>
#include <cstdint>

#include "capture/array.h"
#include "scene/uniform_block.h"

namespace rainref::judge {

enum class Likeness : std::uint8_t {
  same,
  rounded,  ///< as near as a host in float comes
  other
};

/// Tolerance relative to the largest component of a vector, because rotations and differences mix components.
inline constexpr double host_share = 0x1p-18;
/// Tolerance at zero for a member that may be negative: cos(pi / 2) in float is -2^-24.5. Relative to 1, or to a smaller declared range.
inline constexpr double host_floor = 0x1p-22;

/// Compares one member at its offset in two blocks or records. Integers are equal or different.
Likeness compare_member(const scene::Member& member, const std::byte* expected, const std::byte* given);
/// Returns the worst of all values. Records with ids may come in any order. For an empty list, a record of zeros is accepted, because an
/// API may have to bind one.
Likeness compare_arrays(const capture::Array& expected, const capture::Array& given);

}  // namespace rainref::judge
