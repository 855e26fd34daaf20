// Mistakes in a finished buffer: orientation, channel order, encoding, timing.
#include "faults/generators.h"

#include <algorithm>
#include <cstring>

#include "faults/image_faults.h"
#include "faults/members.h"
#include "image/colour.h"
#include "judge/rearrange.h"
#include "math/half.h"
#include "math/real64.h"

namespace rainref::faults {
namespace {

using capture::Array;
using capture::PassCase;
using judge::flip_columns;
using judge::flip_rows;
using judge::shift;
using judge::Slot;
using judge::slots_of;
using judge::store_value;
using judge::stored_value;
using judge::swap_channels;

std::size_t texel_offset(const Array& a, int x, int y) {
  return (static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width) + static_cast<std::size_t>(x)) * a.element_bytes();
}
/// Applies a function to every value of an image.
template <class Change>
void change_values(Array& a, const Slot& any, Change change) {
  Slot s = any;
  const int channels = info(a.format).channels;
  std::byte* const texels = a.levels[0].edit().data();
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      for (s.channel = 0; s.channel < std::min(channels, 3); ++s.channel) {
        std::byte* at = texels + s.offset(x, y);
        store_value(s, change(stored_value(s, at)), s.store_rounding, at);
      }
    }
  }
}

}  // namespace

void add_output_faults(std::vector<Fault>& out, const PassCase& c, const PassCase* before) {
  const std::vector<Slot> slots = slots_of(c);
  std::vector<int> images;
  for (const Slot& s : slots)
    if (images.empty() || images.back() != s.output) images.push_back(s.output);
  if (images.empty()) return;
  const auto each = [&](Kind kind, std::function<void(Array&)> alter) {
    out.emplace_back(What{kind}, false).alter_outputs = [images, alter](const PassCase&, std::vector<Array>& arrays) {
      for (const int i : images) alter(arrays[static_cast<std::size_t>(i)]);
      return !images.empty();
    };
  };
  each(Kind::upside_down, flip_rows);
  each(Kind::mirrored, flip_columns);
  each(Kind::transposed, judge::transpose);
  each(Kind::one_column_off, [](Array& a) { shift(a, 1, 0); });
  each(Kind::one_column_off_other_way, [](Array& a) { shift(a, -1, 0); });
  each(Kind::one_row_off, [](Array& a) { shift(a, 0, 1); });
  each(Kind::one_row_off_other_way, [](Array& a) { shift(a, 0, -1); });
  each(Kind::last_column_not_written, [](Array& a) {
    for (int y = 0; y < a.height; ++y) std::memset(a.levels[0].edit().data() + texel_offset(a, a.width - 1, y), 0, a.element_bytes());
  });
  each(Kind::last_row_not_written, [](Array& a) {
    std::memset(a.levels[0].edit().data() + texel_offset(a, 0, a.height - 1), 0, a.element_bytes() * static_cast<std::size_t>(a.width));
  });
  each(Kind::partial_workgroups_not_written, [](Array& a) {
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x)
        if (x >= a.width / 8 * 8 || y >= a.height / 8 * 8)
          std::memset(a.levels[0].edit().data() + texel_offset(a, x, y), 0, a.element_bytes());
  });
  each(Kind::not_written, [](Array& a) { std::ranges::fill(a.levels[0].edit(), std::byte{0}); });

  for (const int i : images) {
    const capture::CaseOutput& o = c.outputs[static_cast<std::size_t>(i)];
    const FormatInfo& f = info(o.array.format);
    const Slot slot = *std::find_if(slots.begin(), slots.end(), [&](const Slot& s) { return s.output == i; });
    const auto one = [&, at = static_cast<std::size_t>(i)](Kind kind, std::function<void(Array&)> alter, int channel = -1) {
      std::vector<std::string> of{o.name};
      if (channel >= 0) of.push_back(component_name(channel));
      out.emplace_back(What{kind, std::move(of)}, channel >= 0).alter_outputs = [at, alter](const PassCase&, std::vector<Array>& arrays) {
        alter(arrays[at]);
        return true;
      };
    };
    if (f.channels >= 2) one(Kind::output_pair_swapped, [](Array& a) { swap_channels(a, 0, 1); });
    if (f.channels >= 3) one(Kind::output_as_bgra, [](Array& a) { swap_channels(a, 0, 2); });
    if (f.channels >= 3) one(Kind::output_second_pair_swapped, [](Array& a) { swap_channels(a, 1, 2); }), out.back().for_diagnosis = true;
    for (int k = 0; k < f.channels; ++k) {
      if (f.kind == FormatInfo::float16 || f.kind == FormatInfo::float32) one(Kind::output_channel_negated, negating_channel(f, k), k);
      one(Kind::output_without_channel, clearing_channel(f, k), k);
    }
    const auto changed = [&](Kind kind, float (*change)(float)) {
      one(kind, [slot, change](Array& a) { change_values(a, slot, change); });
    };
    if (f.kind == FormatInfo::unorm8 && f.channels >= 3) {
      changed(Kind::output_encoded_twice, [](float v) { return static_cast<float>(encode_srgb(v)); });
      changed(Kind::output_not_encoded, [](float v) { return static_cast<float>(decode_srgb(v)); });
    }
    if (f.kind == FormatInfo::float32) changed(Kind::output_through_half, [](float v) { return to_float(to_half(v)); });
    if (f.kind == FormatInfo::float16) {
      changed(Kind::output_through_8_bits, [](float v) { return to_float(to_unorm8(v)); });
      changed(Kind::output_in_coarser_steps, [](float v) { return to_float(Half{static_cast<std::uint16_t>(to_half(v).bits & 0xfffeu)}); });
    }
    if (const capture::CaseInput* in = c.input(o.name);
        in && in->array.levels.size() == 1 && in->array.levels[0].size() == o.array.levels[0].size()) {
      for (int k = 0; f.channels > 1 && k < f.channels; ++k) one(Kind::output_keeps_channel, taking_channel(in->array, k, k), k);
      one(Kind::output_is_its_input, [stale = in->array](Array& a) { a.levels = stale.levels; });
    }
    if (const capture::CaseOutput* old = before ? before->output(o.name) : nullptr;
        old && old->array.levels[0].size() == o.array.levels[0].size())
      one(Kind::output_stale, [stale = old->array](Array& a) { a.levels = stale.levels; });
  }
}

}  // namespace rainref::faults
