// Where the values of an invocation lie in the outputs of a case.
#pragma once

#include <string>
#include <vector>

#include "capture/pass_model.h"
#include "image/code_range.h"
#include "judge/verdict.h"

namespace rainref::judge {

/// One value of every invocation: a channel of an output that is_placed().
struct Slot {
  int output, channel;
  FormatInfo::Kind kind;
  int channel_bytes, texel_bytes, width;
  Rounding store_rounding;
  double range;  ///< extent of the declared range

  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(texel_bytes) +
           static_cast<std::size_t>(channel * channel_bytes);
  }
  const std::byte* at(const capture::Array& a, int x, int y) const { return a.levels[0].data() + offset(x, y); }
  std::int64_t code(const capture::Array& a, int x, int y) const { return enclosed::ordered_code(kind, at(a, x, y)); }
  /// Whether two stored values have one code, below the largest of their format: beyond that a profile says what a store may do. The zeros
  /// are one code.
  bool is_same(const std::byte* a, const std::byte* b) const;
};
std::vector<Slot> slots_of(const capture::PassCase& c);
/// The same with the ranges that the model knows better.
std::vector<Slot> slots_of(const capture::PassCase& c, const capture::PassModel& model);

/// Whether an output is judged value by value where it stands: an image by envelope, or a keyed list whose records have no id, so that
/// their place is the key. Such a list is a row of texels.
bool is_placed(const capture::CaseOutput& output);

/// Why a list whose records stand at their places cannot be judged, or "": "out.drops: expected 10 records, found 0". `stored`: in the
/// order of c.outputs.
std::string length_fault(const capture::PassCase& c, const std::vector<capture::Array>& stored);

/// A stored value as a shader reads it.
float stored_value(const Slot& slot, const std::byte* at);
/// The middle of the values that are stored so: a store toward zero leaves what lies up to a step farther from it.
float middle_value(const Slot& slot, const std::byte* at, HalfMode mode);
/// Whether a stored float is not a number.
bool is_nan(FormatInfo::Kind kind, const std::byte* at);
/// How a slot is stored where a device rounds its halves like this; `either` is the reference's own way.
Rounding rounding_of(const Slot& slot, HalfMode mode);
/// Whether every slot is stored so as the reference stores it.
bool is_own_rounding(const std::vector<Slot>& slots, HalfMode mode);
/// Stores as the reference does.
void store_value(const Slot& slot, float value, Rounding rounding, std::byte* at);

}  // namespace rainref::judge
