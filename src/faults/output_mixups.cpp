#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "faults/whole_faults.h"
#include "image/colour.h"
#include "judge/rearrange.h"

namespace rainref::faults {
namespace {

using capture::Array;
using capture::PassCase;
using judge::Slot;

double held(double v) { return v > 0 ? v < 1 ? v : 1 : 0; }

/// Alpha keeps its value: the fourth channel of four. Of all channels, and of each alone.
void add_values(std::vector<Fault>& out, const PassCase& c) {
  const std::vector<Slot> slots = judge::slots_of(c);
  const auto add = [&](std::string name, std::string sentence, double (*change)(double)) {
    Fault d;
    d.name = name;
    d.sentence = sentence;
    d.alter_value = [change](float v, const Slot& s) { return s.channel == 3 ? v : static_cast<float>(change(v)); };
    d.for_diagnosis = true;
    out.push_back(d);
    for (const Slot& only : slots) {
      if (slots.size() < 2 || only.channel == 3) continue;
      const std::string& output = c.outputs[static_cast<std::size_t>(only.output)].name;
      d.name = fmt::format("{}, {} of {} alone", name, "xyzw"[only.channel & 3], output);
      d.sentence = fmt::format("{}, in channel {} of {}", sentence, "xyzw"[only.channel & 3], output);
      d.alter_value = [change, output = only.output, channel = only.channel](float v, const Slot& s) {
        return s.output == output && s.channel == channel ? static_cast<float>(change(v)) : v;
      };
      out.push_back(d);
    }
  };
  add("encoding left out", "the result is stored without the sRGB encoding", [](double v) { return decode_srgb(held(v)); });
  add("sRGB encoded", "the result is encoded as sRGB, once more or where it should be linear",
      [](double v) { return encode_srgb(held(v)); });
  add("power of 1/2.2 for sRGB", "the result is encoded by a power of 1/2.2 in place of the sRGB curve",
      [](double v) { return encode_gamma22(decode_srgb(held(v))); });
  add("power of 1/2.2", "the result is encoded by a power of 1/2.2", [](double v) { return encode_gamma22(held(v)); });
  add("power of 2.2", "the result is decoded by a power of 2.2", [](double v) { return decode_gamma22(held(v)); });
  add("clamped to [0, 1]", "the result is clamped to [0, 1] before the store", held);
  add("rounded to 8 bits", "the result is held to [0, 1] and rounded to steps of 1/255 before the store",
      [](double v) { return std::floor(held(v) * 255 + 0.5) / 255; });
  add("without its sign", "the absolute value is stored", [](double v) { return std::abs(v); });
  add("packed as v / 2 + 1/2", "the result is packed from [-1, 1] to [0, 1]", [](double v) { return v / 2 + 0.5; });
  add("unpacked as 2 v - 1", "the result is unpacked from [0, 1] to [-1, 1], or not packed", [](double v) { return 2 * v - 1; });
  add("1 - v", "the result is taken from 1", [](double v) { return 1 - v; });
  add("negated", "the result has the other sign", [](double v) { return -v; });
  add("times 255/256", "the result is scaled by 255/256 before the store", [](double v) { return v * (255.0 / 256); });
  add("times 256/255", "the result is scaled by 256/255 before the store", [](double v) { return v * (256.0 / 255); });
  add("squared", "the result is squared", [](double v) { return v * v; });
  add("as its root", "the root of the result is stored", [](double v) { return v > 0 ? std::sqrt(v) : v; });
}

/// A channel that holds one number everywhere.
void add_constant_channels(std::vector<Fault>& out, const PassCase& c) {
  for (const Slot& only : judge::slots_of(c))
    for (const float number : {0.0f, 1.0f}) {
      Fault d;
      const std::string& output = c.outputs[static_cast<std::size_t>(only.output)].name;
      d.name = fmt::format("{} in {} of {}", number, "xyzw"[only.channel & 3], output);
      d.sentence = fmt::format("channel {} of {} holds {} here", "xyzw"[only.channel & 3], output, number);
      d.alter_value = [number, o = only.output, channel = only.channel](float v, const Slot& s) {
        return s.output == o && s.channel == channel ? number : v;
      };
      d.for_diagnosis = true;
      out.push_back(std::move(d));
    }
}

/// Of several images each by itself; the other faults turn all of them.
void add_single_images(std::vector<Fault>& out, const PassCase& c, const PassCase* before) {
  std::vector<std::size_t> images;
  for (std::size_t o = 0; o < c.outputs.size(); ++o)
    if (c.outputs[o].judge == capture::Judge::envelope && !c.outputs[o].array.is_records) images.push_back(o);
  for (const std::size_t o : images) {
    const std::string& name = c.outputs[o].name;
    const auto add = [&](const char* what, std::string sentence, std::function<void(Array&)> alter) {
      Fault d;
      d.name = fmt::format("{} {}", name, what);
      d.sentence = std::move(sentence);
      d.alter_outputs = [o, alter](const PassCase&, std::vector<Array>& arrays) {
        alter(arrays[o]);
        return true;
      };
      d.for_diagnosis = true;
      out.push_back(std::move(d));
    };
    if (images.size() > 1) {
      add("upside down", fmt::format("{} alone is stored from the bottom up", name), judge::flip_rows);
      add("mirrored", fmt::format("{} alone is mirrored left to right", name), judge::flip_columns);
      for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)})
        add(dx ? "one column off" : "one row off", fmt::format("{} alone is shifted by one texel", name),
            [dx = dx, dy = dy](Array& a) { judge::shift(a, dx, dy); });
      add("not written", fmt::format("{} keeps zeros", name),
          [](Array& a) { std::fill(a.levels[0].begin(), a.levels[0].end(), std::byte{0}); });
    }
    for (const std::size_t other : images) {
      const Array &a = c.outputs[o].array, &b = c.outputs[other].array;
      if (other == o || a.format != b.format || a.width != b.width || a.height != b.height) continue;
      const std::string& name_of_other = c.outputs[other].name;
      add(fmt::format("is {}", name_of_other).c_str(), fmt::format("{} is stored where {} belongs", name_of_other, name),
          [from = b](Array& to) { to.levels = from.levels; });
      if (other < o) continue;
      Fault d;
      d.name = fmt::format("{} and {} exchanged", name, name_of_other);
      d.sentence = fmt::format("{} and {} are stored in each other's place", name, name_of_other);
      d.alter_outputs = [o, other](const PassCase&, std::vector<Array>& arrays) {
        std::swap(arrays[o].levels, arrays[other].levels);
        return true;
      };
      d.for_diagnosis = true;
      out.push_back(std::move(d));
    }
    const FormatInfo& f = info(c.outputs[o].array.format);
    for (const capture::CaseInput& in : c.inputs) {
      if (in.array.is_records || in.array.format != c.outputs[o].array.format || in.array.levels.size() != 1 ||
          in.array.levels[0].size() != c.outputs[o].array.levels[0].size())
        continue;
      for (int to = 0; to < f.channels; ++to)
        for (int from = 0; from < f.channels; ++from) {
          if (to == from && in.name == name) continue;
          add(fmt::format("takes its {} from {}.{} as it is", "xyzw"[to], in.name, "xyzw"[from]).c_str(),
              fmt::format("channel {} of {} is {}.{} of before the pass", "xyzw"[to], name, in.name, "xyzw"[from]),
              [source = in.array, to, from](Array& a) {
                const std::size_t n = static_cast<std::size_t>(info(a.format).channel_bytes);
                for (std::size_t t = 0; t + a.element_bytes() <= a.levels[0].size(); t += a.element_bytes())
                  std::memcpy(a.levels[0].data() + t + n * static_cast<std::size_t>(to),
                              source.levels[0].data() + t + n * static_cast<std::size_t>(from), n);
              });
        }
    }
    const capture::CaseOutput* old = before ? before->output(name) : nullptr;
    for (int k = 0; old && f.channels > 1 && k < f.channels && old->array.levels[0].size() == c.outputs[o].array.levels[0].size(); ++k) {
      const Array stale = old->array;
      add(fmt::format("with a stale {}", "xyzw"[k]).c_str(), fmt::format("channel {} of {} is that of the run before", "xyzw"[k], name),
          [stale, k](Array& a) {
            const std::size_t n = static_cast<std::size_t>(info(a.format).channel_bytes);
            for (std::size_t t = n * static_cast<std::size_t>(k); t + n <= a.levels[0].size(); t += a.element_bytes())
              std::memcpy(a.levels[0].data() + t, stale.levels[0].data() + t, n);
          });
    }
    for (int from = 0; f.channels > 2 && from < 3; ++from)
      add(fmt::format("with its {} for each", "xyzw"[from]).c_str(), fmt::format("of {} {} is stored in each channel", name, "xyzw"[from]),
          [from](Array& a) {
            for (int to = 0; to < 3; ++to)
              if (to != from) judge::copy_channel(a, from, to);
          });
    for (int from = 0; from < f.channels; ++from)
      for (int to = 0; to < f.channels; ++to) {
        if (from == to) continue;
        add(fmt::format("with its {} for {}", "xyzw"[from], "xyzw"[to]).c_str(),
            fmt::format("channel {} of {} holds what belongs into {}", "xyzw"[to], name, "xyzw"[from]),
            [from, to](Array& a) { judge::copy_channel(a, from, to); });
        if (from < to && !(from == 0 && to == 1))
          add(fmt::format("with its {} and {} exchanged", "xyzw"[from], "xyzw"[to]).c_str(),
              fmt::format("channels {} and {} of {} are exchanged", "xyzw"[from], "xyzw"[to], name),
              [from, to](Array& a) { judge::swap_channels(a, from, to); });
      }
  }
}

/// What a pass computes from the texel's own place, its column met as a number and its row as a constant.
void add_centres(std::vector<Fault>& out, const Probed& p) {
  const auto add = [&](std::string name, std::string sentence, float dx, float dy, bool mirrors_x, bool mirrors_y) {
    Fault d;
    d.name = std::move(name);
    d.sentence = std::move(sentence);
    const float last_column = static_cast<float>(p.model.width() - 1), rows = static_cast<float>(p.model.height());
    d.at_texel = [=](Texel at, perturbed::Behaviour& b, std::vector<float>&) {
      b.column_offset = mirrors_x ? last_column : dx;
      b.is_column_mirrored = mirrors_x;
      const float centre = static_cast<float>(at.y) + 0.5f;
      if (dy == 0 && !mirrors_y) return;
      b.fault = perturbed::Fault::constant;
      b.constant = centre;
      b.replacement = mirrors_y ? rows - centre : centre + dy;
    };
    d.for_diagnosis = true;
    out.push_back(std::move(d));
  };
  add("half a texel of the pixel's centre missing", "the pixel's place is computed from (i, j) in place of (i + 1/2, j + 1/2)", -0.5f,
      -0.5f, false, false);
  add("half a texel of the pixel's x missing", "the pixel's x is computed from i in place of i + 1/2", -0.5f, 0, false, false);
  add("half a texel of the pixel's y missing", "the pixel's y is computed from j in place of j + 1/2", 0, -0.5f, false, false);
  add("the pixel's centre half a texel too far", "the pixel's place is computed from (i + 1, j + 1)", 0.5f, 0.5f, false, false);
  add("the pixel's y from the other end", "the pixel's y is counted from the top where it should be from the bottom", 0, 0, false, true);
  add("the pixel's x from the other end", "the pixel's x is counted from the right", 0, 0, true, false);
}

}  // namespace

void add_output_mixups(std::vector<Fault>& out, const Probed& p, const PassCase* before) {
  add_values(out, p.c);
  add_constant_channels(out, p.c);
  add_single_images(out, p.c, before);
  add_centres(out, p);
}

}  // namespace rainref::faults
