// What the tests of wipe_texture and normals share.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "image/images.h"
#include "math/half.h"
#include "pass/run.h"
#include "rainref/executor.h"
#include "windshield/scalar.h"
#include "windshield/surface/surface.h"

namespace rainref::windshield {

inline constexpr double pi = 3.14159265358979323846;

inline const parallel::Executor& two_threads() {
  static const parallel::Executor executor(2);
  return executor;
}
inline double at(const Image& image, int x, int y) { return to_float(image.row<Half>(y)[x]); }
inline Image filled(int width, int height, double value) {
  return make_image(Format::r16f, width, height, [=](int, int, int) { return to_half(static_cast<float>(value)); });
}

inline void run_normals(const parallel::Executor& executor, const SurfaceSettings& s, const Image& height, const Image& mask,
                        Image& normal) {
  pass::HostIo<NormalsPass> io;
  io.height = height;
  io.mask = mask;
  io.normal = normal;
  pass::Run<NormalsPass>(normals_uniforms(s), s.corrected, s.rounding, io).tiles(executor, 8);
}

/// A glass of 1.4 m x 0.8 m with this angle between its axes, for the variant.
inline SurfaceSettings settings_on(bool corrected, int width, int height, double phi = pi / 2) {
  SurfaceSettings s;
  s.corrected = corrected;
  s.width = width;
  s.height = height;
  s.frame = corrected ? std::array<double, 3>{1.4, 0.8 * std::cos(phi), 0.8 * std::sin(phi)} : std::array<double, 3>{1.4, 0, 0.8};
  return s;
}

/// A blade that turns from one angle to another [rad] about a point of the plane [m].
struct Blade {
  double pivot_x = 0.7, pivot_y = 0.05, inner = 0.15, outer = 0.65, half_width = 6e-3;
};
inline Wiper wiper(const SurfaceSettings& s, const Blade& b, double from, double to, double dt = 1.0 / 60) {
  Wiper w{};
  const auto uv = [&](double r, double angle, float(&out)[2]) {
    const double x = b.pivot_x + r * std::cos(angle), y = b.pivot_y + r * std::sin(angle), v = y / s.frame[2];
    out[0] = static_cast<float>((x - s.frame[1] * v) / s.frame[0]);
    out[1] = static_cast<float>(v);
  };
  uv(b.inner, from, w.previous_inner);
  uv(b.outer, from, w.previous_outer);
  uv(b.inner, to, w.inner);
  uv(b.outer, to, w.outer);
  w.pivot[0] = static_cast<float>(b.pivot_x);
  w.pivot[1] = static_cast<float>(b.pivot_y);
  w.inner_radius = static_cast<float>(b.inner);
  w.outer_radius = static_cast<float>(b.outer);
  w.previous_axis[0] = static_cast<float>(std::cos(from));
  w.previous_axis[1] = static_cast<float>(std::sin(from));
  w.axis[0] = static_cast<float>(std::cos(to));
  w.axis[1] = static_cast<float>(std::sin(to));
  w.half_width = static_cast<float>(b.half_width);
  w.rate = static_cast<float>((to - from) / dt);
  w.direction = to > from ? 1.0f : to < from ? -1.0f : 0.0f;
  return w;
}

/// Height, mask and time since a wipe, as an effect keeps them.
struct Glass {
  SurfaceSettings settings;
  Image height, mask, wiped;
  Glass(const SurfaceSettings& s, double water) : settings(s), height(filled(s.width, s.height, water)), mask(make_mask(s)) {
    if (s.corrected) wiped = make_wiped(s);
  }
  void wipe(const std::vector<Wiper>& wipers, int frame = 0, const parallel::Executor& executor = two_threads()) {
    WipeTextureUniforms u = wipe_texture_uniforms(settings, frame);
    u.wiper_count = static_cast<std::int32_t>(wipers.size());
    const auto io = wipe_texture_io(settings.corrected, wipers, {&height, &mask, settings.corrected ? &wiped : nullptr});
    pass::Run<WipeTexturePass>(u, settings.corrected, settings.rounding, io).tiles(executor, 8);
  }
  /// Share of the water that is gone, as an area of the real glass [m^2].
  double cleared(double water) const {
    double sum = 0;
    for (int y = 0; y < settings.height; ++y) {
      for (int x = 0; x < settings.width; ++x) sum += 1 - at(height, x, y) / water;
    }
    return sum * settings.frame[0] * settings.frame[2] / settings.width / settings.height;
  }
};

}  // namespace rainref::windshield
