// Locations of an invocation's values in the outputs of a case.
#pragma once

#include <string>
#include <vector>

#include "capture/pass_model.h"
#include "image/code_range.h"
#include "judge/verdict.h"
#include "port_dump/kept.h"

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
  /// True if two stored values have one code, below the largest of their format; beyond it the profile says what a store may do. +0 and -0
  /// are one code.
  bool is_same(const std::byte* a, const std::byte* b) const;
};
std::vector<Slot> slots_of(const capture::PassCase& c);
/// The same with the model's own ranges where it has them.
std::vector<Slot> slots_of(const capture::PassCase& c, const capture::PassModel& model);

/// True if an output is judged value by value at its place: an image by envelope, or a keyed list whose records have no id, so that the
/// index is the key. Such a list is a row of texels.
bool is_placed(const capture::CaseOutput& output);

/// Explains why a list of records that are matched by their place cannot be judged, or returns "": "out.drops: expected 10 records, found
/// 0". `stored`: in the order of c.outputs. `kept`: what its form leaves open.
std::string length_fault(const capture::PassCase& c, const std::vector<capture::Array>& stored, const port_dump::KeptForms& kept);

/// Converts a stored value as a shader reads it.
float stored_value(const Slot& slot, const std::byte* at);
/// The middle of the values that are stored as this code: a store toward zero maps values up to one step farther from zero to it.
float middle_value(const Slot& slot, const std::byte* at, HalfMode mode);
/// True if a stored float is NaN.
bool is_nan(FormatInfo::Kind kind, const std::byte* at);
/// Rounding of a slot's store on a device with this rounding of halves; `either` is the reference's own.
Rounding rounding_of(const Slot& slot, HalfMode mode);
/// True if every slot is stored with the reference's rounding.
bool is_own_rounding(const std::vector<Slot>& slots, HalfMode mode);
/// Stores a value as the reference does.
void store_value(const Slot& slot, float value, Rounding rounding, std::byte* at);

}  // namespace rainref::judge
