// What another format, an exporter or a blend makes of the values of an image.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "faults/generators.h"
#include "faults/image_faults.h"
#include "faults/members.h"
#include "judge/rearrange.h"
#include "math/half.h"

namespace rainref::faults {
namespace {

using capture::Array;
using judge::Slot;

/// A number without a sign and with this many bits of mantissa behind its first, whose exponent is a half's.
float unsigned_float(float v, int mantissa_bits, bool to_nearest) {
  if (!(v > 0)) return 0;
  if (std::isinf(v)) return v;
  int exponent;
  std::frexp(v, &exponent);
  const double step = std::ldexp(1.0, std::max(exponent - 1, -14) - mantissa_bits);
  const double steps = static_cast<double>(v) / step;
  return static_cast<float>((to_nearest ? std::nearbyint(steps) : std::floor(steps)) * step);
}

/// Every value on its way to the store, of images of three or four channels of halves or floats.
void add_formats(std::vector<Fault>& out, const capture::PassCase& c) {
  const auto is_wide = [](const capture::PassCase& in, const Slot& s) {
    const Array& a = in.outputs[static_cast<std::size_t>(s.output)].array;
    return info(a.format).channels >= 3 && (s.kind == FormatInfo::float16 || s.kind == FormatInfo::float32);
  };
  const std::vector<Slot> slots = judge::slots_of(c);
  if (std::none_of(slots.begin(), slots.end(), [&](const Slot& s) { return is_wide(c, s); })) return;
  const auto add = [&](Kind kind, std::function<float(float, int channel)> change) {
    Fault& d = out.emplace_back(What{kind});
    std::vector<int> of;
    for (const Slot& s : slots)
      if (is_wide(c, s)) of.push_back(s.output);
    d.alter_value = [of, change](float v, const Slot& s) {
      return std::find(of.begin(), of.end(), s.output) != of.end() ? change(v, s.channel) : v;
    };
    d.stores = judge::HalfMode::rne;  // whoever makes halves of them is no store of the device
  };
  add(Kind::through_10_bits, [](float v, int channel) {
    const double most = channel == 3 ? 3 : 1023;
    return static_cast<float>(std::floor(std::clamp<double>(v, 0, 1) * most + 0.5) / most);
  });
  for (const bool to_nearest : {true, false})
    add(to_nearest ? Kind::through_11_bits : Kind::through_11_bits_cut,
        [to_nearest](float v, int channel) { return channel == 3 ? 1 : unsigned_float(v, channel == 2 ? 5 : 6, to_nearest); });
}

/// Codes of 10, 10, 10 and 2 bits, read as four of 8: where they are the reference's, the port's own bytes are explained.
void add_packed_codes(std::vector<Fault>& out, const capture::PassCase& c, const std::vector<Array>& port) {
  for (const bool is_red_first : {true, false})
    add_to_images(out, c, port, is_red_first ? Kind::rgb10_read_as_rgba8 : Kind::bgr10_read_as_rgba8, [=](Array& a, const Array& stored) {
      if (info(a.format).channels != 4 || info(a.format).channel_bytes != 1) return false;
      for (std::size_t t = 0; t + 4 <= a.levels[0].size(); t += 4) {
        std::uint32_t packed;
        std::memcpy(&packed, stored.levels[0].data() + t, 4);
        bool is_same = true;
        for (std::size_t k = 0; k < 4; ++k) {
          const std::uint32_t shift = k == 3 ? 30 : static_cast<std::uint32_t>(10 * (is_red_first ? k : 2 - k));
          const double code = k == 3 ? 85.0 * (packed >> 30) : (packed >> shift & 1023) * (255.0 / 1023);
          is_same &= std::abs(code - std::to_integer<int>(a.levels[0][t + k])) <= 1.25;
        }
        if (is_same) std::memcpy(a.levels[0].data() + t, &packed, 4);
      }
      return true;
    });
}

/// Calls change(channel, alpha) for the three colours of each texel of an image of four halves or floats.
template <class Change>
bool change_colours(Array& a, Change change) {
  const FormatInfo& f = info(a.format);
  if (a.is_records || f.channels != 4 || (f.kind != FormatInfo::float16 && f.kind != FormatInfo::float32)) return false;
  judge::each_texel(a, [&](std::byte* t) {
    const float alpha = channel_at(f, t + 3 * f.channel_bytes);
    for (int k = 0; k < 3; ++k) put_channel(f, t + k * f.channel_bytes, change(channel_at(f, t + k * f.channel_bytes), alpha));
  });
  return true;
}
void add_alpha(std::vector<Fault>& out, const Probed& p, const std::vector<Array>& port) {
  const capture::PassCase& c = p.c;
  for (const bool is_multiplied : {true, false}) {
    const auto change = [is_multiplied](float v, float alpha) { return is_multiplied ? v * alpha : alpha > 0 ? v / alpha : v; };
    const auto kind = [&](Kind multiplied, Kind divided) { return is_multiplied ? multiplied : divided; };
    add_to_images(out, c, port, kind(Kind::multiplied_by_alpha, Kind::divided_by_alpha),
                  [change](Array& a, const Array&) { return change_colours(a, change); });
    for (const capture::CaseInput& in : c.inputs) {
      if (in.array.is_records || info(in.array.format).channels != 4) continue;
      out.emplace_back(What{kind(Kind::input_multiplied_by_alpha, Kind::input_divided_by_alpha), {in.name}}).alter_case =
          [input = in.name, change](capture::PassCase& altered) {
            for (capture::CaseInput& i : altered.inputs)
              if (i.name == input) change_colours(i.array, change);
          };
    }
    for (const scene::Member& m : p.pass.block.members) {
      if (m.scalar != scene::Scalar::float32 || m.components != 4 || !is_colour(m)) continue;
      out.emplace_back(What{kind(Kind::uniform_multiplied_by_alpha, Kind::uniform_divided_by_alpha), {m.name}}).alter_case =
          [offset = m.offset, change](capture::PassCase& altered) {
            auto colour = number_at<std::array<float, 4>>(altered.uniforms.data(), offset);
            for (std::size_t k = 0; k < 3; ++k) colour[k] = change(colour[k], colour[3]);
            put_number(altered.uniforms.data(), offset, colour);
          };
    }
  }
}

}  // namespace

void add_format_faults(std::vector<Fault>& out, const Probed& p, const std::vector<Array>& port) {
  const capture::PassCase& c = p.c;
  add_formats(out, c);
  add_packed_codes(out, c, port);
  add_alpha(out, p, port);
  add_to_images(out, c, port, Kind::without_subnormals, [](Array& a, const Array&) {
    if (info(a.format).kind != FormatInfo::float16) return false;
    for (std::vector<std::byte>& level : a.levels)
      for (std::size_t at = 0; at + 2 <= level.size(); at += 2) {
        Half h;
        std::memcpy(&h, level.data() + at, 2);
        if ((h.bits & 0x7c00u) == 0) h.bits &= 0x8000u;
        std::memcpy(level.data() + at, &h, 2);
      }
    return true;
  });
}

}  // namespace rainref::faults
