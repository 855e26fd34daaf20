#include "faults/output_faults.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "image/colour.h"
#include "judge/rearrange.h"
#include "math/half.h"
#include "math/real64.h"

namespace rainref::faults {
namespace {

using capture::Array;
using capture::PassCase;
using judge::each_texel;
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
/// Passes every value of an image through a function.
template <class Change>
void change_values(Array& a, const Slot& any, Change change) {
  Slot s = any;
  const int channels = info(a.format).channels;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      for (s.channel = 0; s.channel < std::min(channels, 3); ++s.channel) {
        std::byte* at = a.levels[0].data() + s.offset(x, y);
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
  const auto add = [&](std::string name, std::string sentence, std::function<bool(const PassCase&, std::vector<Array>&)> alter) {
    Fault d;
    d.name = std::move(name);
    d.sentence = std::move(sentence);
    d.alter_outputs = std::move(alter);
    out.push_back(std::move(d));
  };
  const auto each = [&](std::string name, std::string sentence, std::function<void(Array&)> alter) {
    add(std::move(name), std::move(sentence), [images, alter](const PassCase&, std::vector<Array>& arrays) {
      for (const int i : images) alter(arrays[static_cast<std::size_t>(i)]);
      return !images.empty();
    });
  };
  each("upside down", "the buffer is stored from the bottom up", flip_rows);
  each("mirrored", "the buffer is mirrored left to right", flip_columns);
  each("transposed", "rows and columns are exchanged", judge::transpose);
  each("one column off", "the buffer is shifted by one column", [](Array& a) { shift(a, 1, 0); });
  each("one column off, other way", "the buffer is shifted by one column", [](Array& a) { shift(a, -1, 0); });
  each("one row off", "the buffer is shifted by one row", [](Array& a) { shift(a, 0, 1); });
  each("one row off, other way", "the buffer is shifted by one row", [](Array& a) { shift(a, 0, -1); });
  each("last column not written", "the last column keeps zero: the dispatch is one column short", [](Array& a) {
    for (int y = 0; y < a.height; ++y) std::memset(a.levels[0].data() + texel_offset(a, a.width - 1, y), 0, a.element_bytes());
  });
  each("last row not written", "the last row keeps zero: the dispatch is one row short", [](Array& a) {
    std::memset(a.levels[0].data() + texel_offset(a, 0, a.height - 1), 0, a.element_bytes() * static_cast<std::size_t>(a.width));
  });
  each("partial workgroups not written", "texels beyond the last whole 8 x 8 workgroup keep zero", [](Array& a) {
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x)
        if (x >= a.width / 8 * 8 || y >= a.height / 8 * 8) std::memset(a.levels[0].data() + texel_offset(a, x, y), 0, a.element_bytes());
  });
  each("not written", "the buffer keeps zeros", [](Array& a) { std::fill(a.levels[0].begin(), a.levels[0].end(), std::byte{0}); });

  for (const int i : images) {
    const capture::CaseOutput& o = c.outputs[static_cast<std::size_t>(i)];
    const FormatInfo& f = info(o.array.format);
    const std::size_t at = static_cast<std::size_t>(i);
    const Slot slot = *std::find_if(slots.begin(), slots.end(), [&](const Slot& s) { return s.output == i; });
    const auto one = [&](std::string name, std::string sentence, std::function<void(Array&)> alter, bool for_diagnosis = false) {
      add(fmt::format("{} {}", o.name, name), std::move(sentence), [at, alter](const PassCase&, std::vector<Array>& arrays) {
        alter(arrays[at]);
        return true;
      });
      out.back().for_diagnosis = for_diagnosis;
    };
    if (f.channels >= 2)
      one("with its first two channels swapped", "the first two channels are exchanged: swapped ping-pong",
          [](Array& a) { swap_channels(a, 0, 1); });
    if (f.channels >= 3) one("as BGRA", "red and blue are exchanged", [](Array& a) { swap_channels(a, 0, 2); });
    if (f.channels >= 3)
      one(
          "with its second and third channel swapped", "y and z are exchanged: another axis is up",
          [](Array& a) { swap_channels(a, 1, 2); }, true);
    for (int k = 0; k < f.channels; ++k) {
      const int first = k * f.channel_bytes, last = first + f.channel_bytes;
      if (f.kind == FormatInfo::float16 || f.kind == FormatInfo::float32) {
        one(
            fmt::format("with its {} negated", "xyzw"[k]), fmt::format("channel {} has the other sign", "xyzw"[k]),
            [last](Array& a) { each_texel(a, [last](std::byte* t) { t[last - 1] ^= std::byte{0x80}; }); }, true);
      }
      one(
          fmt::format("without its {}", "xyzw"[k]), fmt::format("channel {} is zero", "xyzw"[k]),
          [first, last](Array& a) { each_texel(a, [first, last](std::byte* t) { std::fill(t + first, t + last, std::byte{0}); }); }, true);
    }
    if (f.kind == FormatInfo::unorm8 && f.channels >= 3) {
      one("sRGB encoded twice", "the display encoding is applied a second time",
          [slot](Array& a) { change_values(a, slot, [](float v) { return static_cast<float>(encode_srgb(v)); }); });
      one("not encoded", "the display encoding is undone: an sRGB view was read back",
          [slot](Array& a) { change_values(a, slot, [](float v) { return static_cast<float>(decode_srgb(v)); }); });
    }
    if (f.kind == FormatInfo::float32) {
      one("through half", "the buffer has half precision (rgba16f instead of rgba32f)",
          [slot](Array& a) { change_values(a, slot, [](float v) { return to_float(to_half(v)); }); });
    }
    if (f.kind == FormatInfo::float16) {
      one("through 8 bits", "the buffer has 8 bits a channel",
          [slot](Array& a) { change_values(a, slot, [](float v) { return to_float(to_unorm8(v)); }); });
      one("in one code coarser steps", "stores lose the last bit", [slot](Array& a) {
        change_values(a, slot, [](float v) { return to_float(Half{static_cast<std::uint16_t>(to_half(v).bits & 0xfffeu)}); });
      });
    }
    if (const capture::CaseInput* in = c.input(o.name);
        in && in->array.levels.size() == 1 && in->array.levels[0].size() == o.array.levels[0].size()) {
      for (int k = 0; f.channels > 1 && k < f.channels; ++k) {
        const Array before_pass = in->array;
        one(
            fmt::format("keeps its {}", "xyzw"[k]), fmt::format("channel {} is that of the state before the pass", "xyzw"[k]),
            [before_pass, k](Array& a) {
              const std::size_t n = static_cast<std::size_t>(info(a.format).channel_bytes), at_k = n * static_cast<std::size_t>(k);
              for (std::size_t t = at_k; t + n <= a.levels[0].size(); t += a.element_bytes())
                std::memcpy(a.levels[0].data() + t, before_pass.levels[0].data() + t, n);
            },
            true);
      }
      const Array stale = in->array;
      one("is its own input", "the buffer is the state before the pass: a stale frame or a missing swap",
          [stale](Array& a) { a.levels = stale.levels; });
    }
    if (const capture::CaseOutput* old = before ? before->output(o.name) : nullptr;
        old && old->array.levels[0].size() == o.array.levels[0].size()) {
      const Array stale = old->array;
      one("stale", "the buffer is that of the run before", [stale](Array& a) { a.levels = stale.levels; });
    }
  }
}

}  // namespace rainref::faults
