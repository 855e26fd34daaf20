// Small puddles, single rays and bare water for the tests of this room.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/error_of.h"
#include "config_of.h"
#include "image/images.h"
#include "rainref/executor.h"
#include "puddle/host.h"
#include "puddle/kernels.h"
#include "puddle/parameters.h"
#include "puddle/scalar.h"
#include "rainref/puddle.h"

namespace rainref::puddle::test {

using Single = scalar::Scalar<float>;
using Double = scalar::Scalar<double>;
template <class N>
using Vec3 = scalar::Vec3<N>;

constexpr double pi = 3.14159265358979323846;
constexpr double degree = pi / 180;

inline const parallel::Executor& executor() {
  static const parallel::Executor one(1);
  return one;
}

/// The settings that a scene of this variant has by default.
inline scene::Config config_of(const std::string& variant, const std::vector<std::string>& overrides = {}) {
  return rainref::test::config_of("puddle", parameters(), variant, "", overrides);
}

/// As published, float storage, clear air, no vignette, image ground.
inline Settings as_published(int width, int height) {
  static const Settings defaults = settings_from(config_of("as-published"));
  Settings s = defaults;
  s.width = width;
  s.height = height;
  s.storage = Format::rg32f;
  s.fog_depth = s.vignette = 0;
  s.tint = {0, 0, 0};
  s.use_checkerboard = false;
  return s;
}
/// A corrected basin of 0.8 m by 0.6 m without rain.
inline Settings corrected(int width, int height) {
  static const Settings defaults = settings_from(config_of("corrected"));
  Settings s = defaults;
  s.width = width;
  s.height = height;
  s.storage = Format::rg32f;
  s.fog_depth = s.vignette = s.exposure = s.rain_rate = 0;
  s.tint = {0, 0, 0};
  s.shape = Shape::basin;
  s.grid = {40, 30};
  s.cell_size = 0.02;
  return s;
}
/// Looks straight down from `height` above the origin; the picture's right is +x, its top -z.
inline Settings looking_down(Settings s, double height) {
  s.camera_position = {0, height, 0};
  s.camera_target = {0, height - 1, 0};
  s.camera_up = {0, 0, -1};
  return s;
}

inline Image uniform_image(int width, int height, float r, float g, float b) {
  const float texel[] = {r, g, b, 1};
  return make_image(Format::rgba32f, width, height, [&](int, int, int c) { return texel[c]; });
}
/// The same radiance from everywhere, over a ground of one albedo. The ambient radiance is a midpoint sum over 64 rows:
/// above the integral by (pi / 64)^2 / 6, 0.04 %.
inline Surroundings uniform_surroundings(float radiance, float albedo) {
  Surroundings s;
  s.environment = uniform_image(128, 64, radiance, radiance, radiance);
  s.ground = uniform_image(2, 2, albedo, albedo, albedo);
  return s;
}

/// A camera whose every pixel sees along `direction`.
inline CameraUniforms single_ray(const std::array<double, 3>& position, const std::array<double, 3>& direction) {
  CameraUniforms c{};
  for (int k = 0; k < 3; ++k) {
    c.position[k] = static_cast<float>(position[k]);
    c.forward[k] = static_cast<float>(direction[k]);
  }
  c.right[0] = 1;
  c.up[1] = 1;
  return c;
}
/// Down by `fall` for each unit of length, otherwise along +x.
inline std::array<double, 3> falling(double fall) { return {std::sqrt(1 - fall * fall), -fall, 0}; }

/// Position (0 to 2), march steps (3), normal (4 to 6) and flag (7) of a pixel.
inline std::array<double, 8> hit_of(const Puddle& p, int x, int y) {
  const float* h = p.hit().row<float>(y) + 4 * x;
  const Half* n = p.normal().row<Half>(y) + 4 * x;
  return {h[0], h[1], h[2], h[3], to_float(n[0]), to_float(n[1]), to_float(n[2]), to_float(n[3])};
}
inline double colour_of(const Puddle& p, int x, int y, int channel) { return to_float(p.colour().row<Half>(y)[4 * x + channel]); }
/// A half keeps 11 bits: the relative error of a stored colour.
constexpr double half_error = 0x1p-11;

/// Water that keeps all of its energy, joined at its edges.
inline Settings undamped(Settings s) {
  s.damping = 1;
  s.boundary = Boundary::periodic;
  return s;
}
inline Settings published_water(int width, int height) { return undamped(as_published(width, height)); }
inline Settings corrected_water() { return undamped(corrected(1, 1)); }

/// A drop in the middle of texel (x, y): as published 1 at that texel, smaller further out.
inline Drop published_drop(float x, float y, float amplitude) { return {x + 0.5f, y + 0.5f, amplitude, 4}; }

/// Water without a picture: wave_step on chosen levels (stored values, row-major) and chosen drops.
struct Water {
  Settings settings;
  WaveStepUniforms uniforms;
  Image newest, previous, rest_row;
  int width, height;

  explicit Water(const Settings& s) : settings(s), uniforms(wave_step_uniforms(s)), width(wave_size(s)[0]), height(wave_size(s)[1]) {
    const Format format = s.storage == Format::rgba8 ? Format::r8 : s.storage == Format::rg16f ? Format::r16f : Format::r32f;
    newest = Image(format, width, height);
    previous = Image(format, width, height);
    rest_row = Image(format, width, 1);
    set(level(uniforms.rest), level(uniforms.rest));
    encode_rows(level(uniforms.rest).data(), rest_row, s.boundary, uniforms.rest, s.rounding);
  }
  bool is_corrected() const { return settings.variant == Variant::corrected; }
  std::vector<float> level(float stored) const { return std::vector<float>(static_cast<std::size_t>(width) * height, stored); }
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
  parallel::Tile all() const { return {0, 0, width, height}; }

  void set(const std::vector<float>& now, const std::vector<float>& before) {
    encode_rows(now.data(), newest, settings.boundary, uniforms.rest, settings.rounding);
    encode_rows(before.data(), previous, settings.boundary, uniforms.rest, settings.rounding);
  }
  void step(const std::vector<Drop>& drops = {}) {
    const WaveJob job{uniforms, is_corrected(), settings.rounding, settings.boundary, &newest, &previous, &rest_row, nullptr, drops};
    wave_step_rows(job, all());
    if (is_corrected() && !drops.empty()) wave_previous_rows(job, all());
    std::swap(newest, previous);
  }
  std::vector<float> decoded(const Image& plane) const {
    std::vector<float> out(static_cast<std::size_t>(width) * height);
    decode_rows(plane, out.data(), all());
    return out;
  }
  std::vector<float> now() const { return decoded(newest); }
  std::vector<float> before() const { return decoded(previous); }
  double mean() const {
    double sum = 0;
    for (const float s : now()) sum += s;
    return sum / (static_cast<double>(width) * height);
  }
};

/// Texels of a wave as surface_hit samples them.
inline TextureData wave_texture(std::vector<float> texels, int width, int height, Address address, float border = 0) {
  TextureData t(std::move(texels), 1, width, height, address, address);
  t.set_border(border, 0, 0, 0);
  return t;
}

/// Bounds for surface_hit_corrected that hold nowhere: the uniforms' own count.
inline TextureData no_local_bounds() { return TextureData({1e6f, 1e6f}, 2, 1, 1, Address::clamp, Address::clamp); }

/// Smallest t in [begin, end] where `below(t)` holds, by steps of `step` and bisection; `end` when there is none.
inline double first_where(double begin, double end, double step, const std::function<bool(double)>& below) {
  double before = begin;
  for (double t = begin; t <= end; before = t, t += step) {
    if (!below(t)) continue;
    double low = before, high = t;
    for (int i = 0; i < 60 && low < high; ++i) {
      const double middle = 0.5 * (low + high);
      (below(middle) ? high : low) = middle;
    }
    return high;
  }
  return end;
}

}  // namespace rainref::puddle::test
