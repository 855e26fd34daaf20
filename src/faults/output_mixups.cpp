#include <algorithm>
#include <cmath>
#include <utility>

#include "faults/generators.h"
#include "faults/image_faults.h"
#include "faults/members.h"
#include "image/colour.h"
#include "judge/rearrange.h"

namespace rainref::faults {
namespace {

using capture::Array;
using capture::PassCase;
using judge::Slot;

double held(double v) { return v > 0 ? v < 1 ? v : 1 : 0; }

/// Alpha (the fourth of four channels) is unchanged. For all channels, and for each alone.
void add_values(std::vector<Fault>& out, const PassCase& c) {
  const std::vector<Slot> slots = judge::slots_of(c);
  const auto add = [&](Kind kind, double (*change)(double)) {
    out.emplace_back(What{kind}).alter_value = [change](float v, const Slot& s) {
      return s.channel == 3 ? v : static_cast<float>(change(v));
    };
    for (const Slot& only : slots) {
      if (slots.size() < 2 || only.channel == 3) continue;
      const std::string& output = c.outputs[static_cast<std::size_t>(only.output)].name;
      out.emplace_back(What{kind, {}, Reach::channel_alone, {component_name(only.channel), output}}).alter_value =
          [change, output = only.output, channel = only.channel](float v, const Slot& s) {
            return s.output == output && s.channel == channel ? static_cast<float>(change(v)) : v;
          };
    }
  };
  add(Kind::encoding_left_out, [](double v) { return decode_srgb(held(v)); });
  add(Kind::srgb_encoded, [](double v) { return encode_srgb(held(v)); });
  add(Kind::power_for_srgb, [](double v) { return encode_gamma22(decode_srgb(held(v))); });
  add(Kind::power_of_inverse_2_2, [](double v) { return encode_gamma22(held(v)); });
  add(Kind::power_of_2_2, [](double v) { return decode_gamma22(held(v)); });
  add(Kind::result_clamped, held);
  add(Kind::result_in_8_bits, [](double v) { return std::floor(held(v) * 255 + 0.5) / 255; });
  add(Kind::result_without_sign, [](double v) { return std::abs(v); });
  add(Kind::result_packed, [](double v) { return v / 2 + 0.5; });
  add(Kind::result_unpacked, [](double v) { return 2 * v - 1; });
  add(Kind::result_from_1, [](double v) { return 1 - v; });
  add(Kind::result_negated, [](double v) { return -v; });
  add(Kind::result_times_255_256, [](double v) { return v * (255.0 / 256); });
  add(Kind::result_times_256_255, [](double v) { return v * (256.0 / 255); });
  add(Kind::result_squared, [](double v) { return v * v; });
  add(Kind::result_as_root, [](double v) { return v > 0 ? std::sqrt(v) : v; });
}

/// A channel with one value everywhere.
void add_constant_channels(std::vector<Fault>& out, const PassCase& c) {
  for (const Slot& only : judge::slots_of(c))
    for (const float number : {0.0f, 1.0f})
      out.emplace_back(What{number == 0 ? Kind::channel_holds_0 : Kind::channel_holds_1,
                            {component_name(only.channel), c.outputs[static_cast<std::size_t>(only.output)].name}})
          .alter_value = [number, o = only.output, channel = only.channel](float v, const Slot& s) {
        return s.output == o && s.channel == channel ? number : v;
      };
}

/// Each of several images alone; the other faults change all of them.
void add_single_images(std::vector<Fault>& out, const PassCase& c, const PassCase* before) {
  const std::vector<std::size_t> images = enveloped_images(c);
  for (const std::size_t o : images) {
    const std::string& name = c.outputs[o].name;
    const auto add = [&](Kind kind, std::vector<std::string> more, std::function<void(Array&)> alter) {
      more.insert(more.begin(), name);
      out.emplace_back(What{kind, std::move(more)}).alter_outputs = [o, alter](const PassCase&, std::vector<Array>& arrays) {
        alter(arrays[o]);
        return true;
      };
    };
    if (images.size() > 1) {
      add(Kind::image_upside_down, {}, judge::flip_rows);
      add(Kind::image_mirrored, {}, judge::flip_columns);
      for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)})
        add(dx ? Kind::image_one_column_off : Kind::image_one_row_off, {}, [dx = dx, dy = dy](Array& a) { judge::shift(a, dx, dy); });
      add(Kind::image_not_written, {}, [](Array& a) { std::ranges::fill(a.levels[0].edit(), std::byte{0}); });
    }
    for (const std::size_t other : images) {
      const Array &a = c.outputs[o].array, &b = c.outputs[other].array;
      if (other == o || a.format != b.format || a.width != b.width || a.height != b.height) continue;
      const std::string& name_of_other = c.outputs[other].name;
      add(Kind::image_is_another, {name_of_other}, [from = b](Array& to) { to.levels = from.levels; });
      if (other < o) continue;
      out.emplace_back(What{Kind::images_exchanged, {name, name_of_other}}).alter_outputs = [o, other](const PassCase&,
                                                                                                       std::vector<Array>& arrays) {
        std::swap(arrays[o].levels, arrays[other].levels);
        return true;
      };
    }
    const FormatInfo& f = info(c.outputs[o].array.format);
    for (const capture::CaseInput& in : c.inputs) {
      if (in.array.is_records || in.array.format != c.outputs[o].array.format || in.array.levels.size() != 1 ||
          in.array.levels[0].size() != c.outputs[o].array.levels[0].size())
        continue;
      for (int to = 0; to < f.channels; ++to)
        for (int from = 0; from < f.channels; ++from) {
          if (to == from && in.name == name) continue;
          add(Kind::image_takes_channel, {component_name(to), in.name, component_name(from)}, taking_channel(in.array, from, to));
        }
    }
    const capture::CaseOutput* old = before ? before->output(name) : nullptr;
    for (int k = 0; old && f.channels > 1 && k < f.channels && old->array.levels[0].size() == c.outputs[o].array.levels[0].size(); ++k)
      add(Kind::image_with_stale_channel, {component_name(k)}, taking_channel(old->array, k, k));
    for (int from = 0; f.channels > 2 && from < 3; ++from)
      add(Kind::image_channel_for_each, {component_name(from)}, [from](Array& a) {
        for (int to = 0; to < 3; ++to)
          if (to != from) judge::copy_channel(a, from, to);
      });
    for (int from = 0; from < f.channels; ++from)
      for (int to = 0; to < f.channels; ++to) {
        if (from == to) continue;
        const std::vector<std::string> both{component_name(from), component_name(to)};
        add(Kind::image_channel_for_another, both, [from, to](Array& a) { judge::copy_channel(a, from, to); });
        if (from < to && !(from == 0 && to == 1))
          add(Kind::image_channels_exchanged, both, [from, to](Array& a) { judge::swap_channels(a, from, to); });
      }
  }
}

/// Values computed from the texel's position: the column is traced as a number, the row as a constant.
void add_centres(std::vector<Fault>& out, const Probed& p) {
  const auto add = [&](Kind kind, float dx, float dy, bool mirrors_x, bool mirrors_y) {
    const float last_column = static_cast<float>(p.model.width() - 1), rows = static_cast<float>(p.model.height());
    out.emplace_back(What{kind}).at_texel = [=](Texel at, perturbed::Behaviour& b, std::vector<float>&) {
      b.column_offset = mirrors_x ? last_column : dx;
      b.is_column_mirrored = mirrors_x;
      const float centre = static_cast<float>(at.y) + 0.5f;
      if (dy == 0 && !mirrors_y) return;
      b.fault = perturbed::Fault::constant;
      b.constant = centre;
      b.replacement = mirrors_y ? rows - centre : centre + dy;
    };
  };
  add(Kind::centre_missing, -0.5f, -0.5f, false, false);
  add(Kind::centre_x_missing, -0.5f, 0, false, false);
  add(Kind::centre_y_missing, 0, -0.5f, false, false);
  add(Kind::centre_too_far, 0.5f, 0.5f, false, false);
  add(Kind::y_from_other_end, 0, 0, false, true);
  add(Kind::x_from_other_end, 0, 0, true, false);
}

}  // namespace

void add_output_mixups(std::vector<Fault>& out, const Probed& p, const PassCase* before) {
  add_values(out, p.c);
  add_constant_channels(out, p.c);
  add_single_images(out, p.c, before);
  add_centres(out, p);
}

}  // namespace rainref::faults
