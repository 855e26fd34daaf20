// Mistakes in a finished image: added for all of a case's images together, and for each image alone.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <functional>
#include <vector>

#include "faults/fault.h"
#include "faults/members.h"
#include "judge/rearrange.h"
#include "math/half.h"

namespace rainref::faults {

/// Indices of the case's outputs that are images judged by envelope.
inline std::vector<std::size_t> enveloped_images(const capture::PassCase& c) {
  std::vector<std::size_t> out;
  for (std::size_t o = 0; o < c.outputs.size(); ++o)
    if (c.outputs[o].judge == capture::Judge::envelope && !c.outputs[o].array.is_records) out.push_back(o);
  return out;
}

/// Value of a channel of a texel; an 8-bit code is divided by 255.
inline float channel_at(const FormatInfo& f, const std::byte* at) {
  return f.kind == FormatInfo::float32   ? number_at<float>(at, 0)
         : f.kind == FormatInfo::float16 ? to_float(number_at<Half>(at, 0))
                                         : static_cast<float>(std::to_integer<int>(*at)) / 255.0f;
}
/// Stores a channel of half or float.
inline void put_channel(const FormatInfo& f, std::byte* at, float v) {
  if (f.kind == FormatInfo::float16)
    put_number(at, 0, to_half(v));
  else
    put_number(at, 0, v);
}

using Alter = std::function<void(capture::Array&)>;
/// Replaces channel `to` of each texel by channel `from` of another image of the same format and size.
inline Alter taking_channel(const capture::Array& source, int from, int to) {
  return [source, from, to](capture::Array& a) {
    const std::size_t n = static_cast<std::size_t>(info(a.format).channel_bytes);
    std::vector<std::byte>& texels = a.levels[0].edit();
    for (std::size_t t = 0; t + a.element_bytes() <= texels.size(); t += a.element_bytes())
      std::memcpy(texels.data() + t + n * static_cast<std::size_t>(to), source.levels[0].data() + t + n * static_cast<std::size_t>(from),
                  n);
  };
}
/// Negates channel k, half or float.
inline Alter negating_channel(const FormatInfo& f, int k) {
  return [last = (k + 1) * f.channel_bytes - 1](capture::Array& a) {
    judge::each_texel(a, [last](std::byte* t) { t[last] ^= std::byte{0x80}; });
  };
}
/// Sets channel k to 0.
inline Alter clearing_channel(const FormatInfo& f, int k) {
  return [first = k * f.channel_bytes, n = f.channel_bytes](capture::Array& a) {
    judge::each_texel(a, [first, n](std::byte* t) { std::fill(t + first, t + first + n, std::byte{0}); });
  };
}

/// Adds alter(image, port's image), which returns false if it does not apply. what(image) describes the first image. The port's images must
/// outlive the fault.
inline void add_to_images(std::vector<Fault>& out, const capture::PassCase& c, const std::vector<capture::Array>& port,
                          const std::function<What(const capture::Array&)>& what,
                          const std::function<bool(capture::Array&, const capture::Array&)>& alter) {
  const std::vector<std::size_t> images = enveloped_images(c);
  const auto add = [&](std::vector<std::size_t> of) -> Fault& {
    Fault& d = out.emplace_back(what(c.outputs[of.front()].array));
    d.alter_outputs = [of, alter, &port](const capture::PassCase&, std::vector<capture::Array>& arrays) {
      bool applies = false;
      for (const std::size_t o : of) applies |= alter(arrays[o], port[o]);
      return applies;
    };
    return d;
  };
  if (!images.empty()) add(images);
  for (std::size_t k = 0; images.size() > 1 && k < images.size(); ++k) {
    Fault& d = add({images[k]});
    d.reach = Reach::image_alone;
    d.where = {c.outputs[images[k]].name};
  }
}
inline void add_to_images(std::vector<Fault>& out, const capture::PassCase& c, const std::vector<capture::Array>& port, Kind kind,
                          const std::function<bool(capture::Array&, const capture::Array&)>& alter) {
  add_to_images(
      out, c, port, [kind](const capture::Array&) { return What{kind}; }, alter);
}

}  // namespace rainref::faults
