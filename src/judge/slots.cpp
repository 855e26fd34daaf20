#include "judge/slots.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "image/colour.h"
#include "judge/keyed.h"
#include "math/scalar.h"
#include "rainref/error.h"

namespace rainref::judge {
namespace {

template <class T>
T loaded(const std::byte* at) {
  T t;
  std::memcpy(&t, at, sizeof t);
  return t;
}

}  // namespace

bool is_placed(const capture::CaseOutput& output) {
  if (!output.array.is_records) return output.judge == capture::Judge::envelope;
  return output.judge == capture::Judge::keyed && !has_key(output.array.record);
}

std::string length_fault(const capture::PassCase& c, const std::vector<capture::Array>& stored, const port_dump::KeptForms& kept) {
  for (std::size_t o = 0; o < c.outputs.size(); ++o) {
    const capture::CaseOutput& expected = c.outputs[o];
    const bool has_places = is_placed(expected) || (!kept.empty() && kept[o] && !kept[o]->from_expected.empty());
    if (expected.array.is_records && has_places && stored[o].width != expected.array.width)
      return fmt::format("out.{}: expected {} records, found {}", expected.name, expected.array.width, stored[o].width);
  }
  return "";
}

std::vector<Slot> slots_of(const capture::PassCase& c, const capture::PassModel& model) {
  std::vector<Slot> slots = slots_of(c);
  for (std::size_t v = 0; v < slots.size(); ++v) slots[v].range = model.extent(static_cast<int>(v)).value_or(slots[v].range);
  return slots;
}
std::vector<Slot> slots_of(const capture::PassCase& c) {
  std::vector<Slot> slots;
  for (std::size_t o = 0; o < c.outputs.size(); ++o) {
    const capture::CaseOutput& out = c.outputs[o];
    if (!is_placed(out)) continue;
    const FormatInfo& f = info(out.array.format);
    for (int k = 0; k < f.channels; ++k) {
      slots.push_back({static_cast<int>(o), k, f.kind, f.channel_bytes, f.texel_bytes(), out.array.width, out.store_rounding,
                       out.range[1] - out.range[0]});
    }
  }
  return slots;
}

float stored_value(const Slot& slot, const std::byte* at) {
  switch (slot.kind) {
    case FormatInfo::unorm8:
      return to_float(loaded<Unorm8>(at));
    case FormatInfo::srgb8:
      return static_cast<float>(decode_srgb(loaded<Unorm8>(at).code / 255.0));
    case FormatInfo::float16:
      return to_float(loaded<Half>(at));
    case FormatInfo::float32:
      return loaded<float>(at);
    case FormatInfo::uint32:
      return static_cast<float>(loaded<std::uint32_t>(at));
  }
  return 0;
}
bool Slot::is_same(const std::byte* a, const std::byte* b) const {
  const std::int64_t code = enclosed::ordered_code(kind, a);
  if (code != enclosed::ordered_code(kind, b)) return false;
  if (kind != FormatInfo::float16 && kind != FormatInfo::float32) return true;
  const std::int64_t largest = kind == FormatInfo::float16 ? 0x7bff : 0x7f7fffff;
  return -largest < code && code < largest;
}
bool is_nan(FormatInfo::Kind kind, const std::byte* at) {
  if (kind == FormatInfo::float16) return (loaded<Half>(at).bits & 0x7fffu) > 0x7c00u;
  if (kind == FormatInfo::float32) return (loaded<std::uint32_t>(at) & 0x7fffffffu) > 0x7f800000u;
  return false;
}
Rounding rounding_of(const Slot& slot, HalfMode mode) {
  if (slot.kind != FormatInfo::float16 || mode == HalfMode::either) return slot.store_rounding;
  return mode == HalfMode::rne ? Rounding::rne : Rounding::rtz;
}
float middle_value(const Slot& slot, const std::byte* at, HalfMode mode) {
  const float stored = stored_value(slot, at);
  if (slot.kind != FormatInfo::float16 || rounding_of(slot, mode) != Rounding::rtz) return stored;
  Half next;
  std::memcpy(&next, at, sizeof next);
  ++next.bits;
  const float beyond = to_float(next);
  return std::isfinite(beyond) ? stored + (beyond - stored) / 2 : stored;
}
bool is_own_rounding(const std::vector<Slot>& slots, HalfMode mode) {
  return std::all_of(slots.begin(), slots.end(), [&](const Slot& s) { return rounding_of(s, mode) == s.store_rounding; });
}
void store_value(const Slot& slot, float value, Rounding rounding, std::byte* at) {
  const scalar::Scalar<float> x(value);
  const auto put = [&](auto stored) {
    scalar::store(&stored, x, rounding);
    std::memcpy(at, &stored, sizeof stored);
  };
  switch (slot.kind) {
    case FormatInfo::unorm8:
      put(Unorm8{});
      return;
    case FormatInfo::float16:
      put(Half{});
      return;
    case FormatInfo::float32:
      put(float{});
      return;
    default:
      throw Error(ExitCode::internal, "store_value: no pass stores this format by envelope");
  }
}

}  // namespace rainref::judge
