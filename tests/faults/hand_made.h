// Passes written by hand from docs/effects/*.md, as a porter would: plain loops of floats that share nothing with the pass texts
// and know nothing of the fault model. A mistake is switched in by name; "" is the correct pass, which must be judged PASS.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "capture/pack_read.h"
#include "math/half.h"

namespace rainref::faults::hand {

struct Float3 {
  float x = 0, y = 0, z = 0;
};
inline Float3 operator+(Float3 a, Float3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Float3 operator-(Float3 a, Float3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Float3 operator*(float s, Float3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline Float3 operator*(Float3 a, Float3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline float dot(Float3 a, Float3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline float length(Float3 a) { return std::sqrt(dot(a, a)); }
inline float mix(float a, float b, float t) { return a * (1 - t) + b * t; }
inline Float3 mix(Float3 a, Float3 b, float t) { return {mix(a.x, b.x, t), mix(a.y, b.y, t), mix(a.z, b.z, t)}; }
inline float saturate(float x) { return std::min(std::max(x, 0.0f), 1.0f); }
inline float smoothstep(float a, float b, float x) {
  const float t = saturate((x - a) / (b - a));
  return t * t * (3 - 2 * t);
}
inline float fract(float x) { return x - std::floor(x); }
inline float power(float x, float y) { return static_cast<float>(std::pow(static_cast<double>(x), static_cast<double>(y))); }
inline float exponential(float x) { return static_cast<float>(std::exp(static_cast<double>(x))); }
inline float srgb(float x) { return x <= 0.0031308f ? 12.92f * x : 1.055f * power(x, 1 / 2.4f) - 0.055f; }

/// A run of a pass with a mistake.
class Run {
 public:
  Run(const capture::PassCase& c, const scene::UniformBlock& block, std::string_view mistake) : c_(c), block_(block), mistake_(mistake) {}
  const capture::PassCase& taken() const { return c_; }
  bool is(std::string_view mistake) const { return mistake_ == mistake; }
  /// What is right, or what the mistake has in its place.
  template <class T>
  T unless(std::string_view mistake, T right, T wrong) const {
    return is(mistake) ? wrong : right;
  }

  /// A component of a uniform.
  float u(std::string_view name, int k = 0) const { return word<float>(name, k); }
  int whole(std::string_view name, int k = 0) const { return word<int>(name, k); }
  Float3 u3(std::string_view name) const { return {u(name, 0), u(name, 1), u(name, 2)}; }

  const capture::CaseInput& input(std::string_view name) const {
    const capture::CaseInput* in = c_.input(name);
    if (!in) throw std::runtime_error("no input " + std::string(name));
    return *in;
  }
  int width(std::string_view name) const { return input(name).array.width; }
  int height(std::string_view name) const { return input(name).array.height; }

  /// Channel k of a texel; beyond the edge as the input says, or by `address`.
  float at(std::string_view name, int x, int y, int k = 0, int level = 0, const Address* address = nullptr) const {
    const capture::CaseInput& in = input(name);
    const int w = in.array.level_width(level), h = in.array.level_height(level);
    const Address au = address ? *address : in.address_u, av = address ? *address : in.address_v;
    if ((au == Address::border && (x < 0 || x >= w)) || (av == Address::border && (y < 0 || y >= h)))
      return in.border[static_cast<std::size_t>(k)];
    x = au == Address::repeat ? ((x % w) + w) % w : std::clamp(x, 0, w - 1);
    y = av == Address::repeat ? ((y % h) + h) % h : std::clamp(y, 0, h - 1);
    const FormatInfo& f = info(in.array.format);
    const std::byte* p = in.array.levels[static_cast<std::size_t>(level)].data() +
                         static_cast<std::size_t>((y * w + x) * f.texel_bytes() + k * f.channel_bytes);
    if (f.kind == FormatInfo::unorm8) return static_cast<float>(std::to_integer<int>(*p)) / 255.0f;
    if (f.kind == FormatInfo::float16) {
      Half half;
      std::memcpy(&half, p, 2);
      return to_float(half);
    }
    float v;
    std::memcpy(&v, p, 4);
    return v;
  }
  Float3 rgb(std::string_view name, int x, int y) const { return {at(name, x, y, 0), at(name, x, y, 1), at(name, x, y, 2)}; }

  /// Bilinear at normalized coordinates, moved by whole texels.
  float linear(std::string_view name, float u, float v, int k = 0, int level = 0, const Address* address = nullptr, int across = 0,
               int along = 0) const {
    const capture::CaseInput& in = input(name);
    const auto held = [&](float c, int size, Address own) {
      const Address a = address ? *address : own;
      const float n = static_cast<float>(size), mirrored = 1 - std::abs(2 * fract(c * 0.5f) - 1);
      const float x = (a == Address::repeat ? fract(c) : a == Address::mirror ? mirrored : c) * n - 0.5f;
      if (a == Address::repeat) return x;
      return a == Address::border ? std::clamp(x, -1.0f, n) : std::clamp(x, 0.0f, n - 1);
    };
    const float x = held(u, in.array.level_width(level), in.address_u), y = held(v, in.array.level_height(level), in.address_v);
    const float x0 = std::floor(x), y0 = std::floor(y);
    const int i = static_cast<int>(x0) + across, j = static_cast<int>(y0) + along;
    const auto texel = [&](int dx, int dy) { return at(name, i + dx, j + dy, k, level, address); };
    return mix(mix(texel(0, 0), texel(1, 0), x - x0), mix(texel(0, 1), texel(1, 1), x - x0), y - y0);
  }
  Float3 linear3(std::string_view name, float u, float v, int level = 0) const {
    return {linear(name, u, v, 0, level), linear(name, u, v, 1, level), linear(name, u, v, 2, level)};
  }
  Float3 trilinear3(std::string_view name, float u, float v, float lod) const {
    const float last = static_cast<float>(input(name).array.levels.size() - 1);
    const float l = std::min(std::max(lod, 0.0f), last), l0 = std::floor(l);
    const int fine = static_cast<int>(l0), coarse = static_cast<int>(std::min(l0 + 1, last));
    return mix(linear3(name, u, v, fine), linear3(name, u, v, coarse), l - l0);
  }
  Float3 nearest3(std::string_view name, float u, float v) const {
    return rgb(name, static_cast<int>(std::floor(u * static_cast<float>(width(name)))),
               static_cast<int>(std::floor(v * static_cast<float>(height(name)))));
  }

  /// A float of record r.
  float of(std::string_view list, int r, std::string_view member, int k = 0) const {
    const capture::Array& a = input(list).array;
    for (const scene::Member& m : a.record.members)
      if (m.name == member) {
        float v;
        std::memcpy(&v, a.levels[0].data() + static_cast<std::size_t>(r) * a.record.size + m.offset + 4 * static_cast<std::size_t>(k), 4);
        return v;
      }
    throw std::runtime_error("no member " + std::string(member));
  }
  int count(std::string_view list) const { return input(list).array.width; }

 private:
  template <class T>
  T word(std::string_view name, int k) const {
    for (const scene::Member& m : block_.members)
      if (m.name == name) {
        T v;
        std::memcpy(&v, c_.uniforms.data() + m.offset + 4 * static_cast<std::size_t>(k), 4);
        return v;
      }
    throw std::runtime_error("no uniform " + std::string(name));
  }

  const capture::PassCase& c_;
  const scene::UniformBlock& block_;
  std::string_view mistake_;
};

/// One invocation: the channels of the outputs at (x, y). False: this run is left as the reference has it.
using Loop = bool (*)(const Run& run, int x, int y, float* out);

struct Mistake {
  std::string mistake;  ///< what is switched in
  /// Parts of names that say so truly: the right one, and what is the same in real numbers. "=...": the whole name. What no
  /// fault says stands in words that none has.
  std::vector<std::string> causes;
};
struct Pass {
  std::string pack, pass;
  Loop loop;
  std::vector<Mistake> mistakes;
};

}  // namespace rainref::faults::hand
