// Pictures that are known, and the passes read over them.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/error_of.h"
#include "edge_splash/host.h"
#include "edge_splash/splash.pass.h"
#include "edge_splash/scalar.h"
#include "image/images.h"
#include "math/half.h"
#include "math/unorm.h"
#include "rainref/edge_splash.h"
#include "settings.h"

namespace rainref::edge_splash {

using F = scalar::Scalar<float>;
using D = scalar::Scalar<double>;
constexpr double pi = 3.141592653589793;

using DepthOf = std::function<double(int x, int y)>;

inline Image plane_of(int width, int height, const DepthOf& value) {
  Image image(Format::r32f, width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.row<float>(y)[x] = static_cast<float>(value(x, y));
  }
  return image;
}
inline Image colour_of(int width, int height, float level, float alpha = 1) {
  Image image(Format::rgba32f, width, height);
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < 4 * width; ++i) image.row<float>(y)[i] = i % 4 == 3 ? alpha : level;
  }
  return image;
}
/// A map with each code `count` times, in an order without pattern.
inline Image uniform_noise(int side) {
  Image image(Format::r8, side, side);
  const std::uint32_t texels = static_cast<std::uint32_t>(side) * static_cast<std::uint32_t>(side);
  for (std::uint32_t i = 0; i < texels; ++i) {
    const std::uint32_t place = (i * 2654435761u) % texels;  // odd factor, power of two: a permutation
    image.row<Unorm8>(static_cast<int>(place / side))[place % side].code = static_cast<std::uint8_t>(i % 256);
  }
  return image;
}
inline Inputs inputs_of(int width, int height, const DepthOf& depth, float level = 0.25f) {
  Inputs in;
  in.colour = colour_of(width, height, level);
  in.depth = plane_of(width, height, depth);
  return in;
}
/// Distances in metres instead of device depths.
inline Inputs inputs_of_distance(int width, int height, const DepthOf& distance, float level = 0.25f) {
  Inputs in = inputs_of(width, height, distance, level);
  in.depth_is_distance = true;
  return in;
}
inline Settings published() {
  Settings s = rainref::test::edge_splash_settings();
  s.variant = Variant::as_published;
  s.rain_drop_scale = 0;  // every noise passes
  return s;
}
/// Every noise passes, thresholds are as sharp as they can be.
inline Settings corrected() {
  Settings s = rainref::test::edge_splash_settings();
  s.variant = Variant::corrected;
  s.rain_drop_scale = 0;
  s.softness = 1e-4;
  return s;
}

inline int code(const Image& mask, int x, int y) { return mask.row<Unorm8>(y)[x].code; }
/// Edge and angle together.
inline bool painted(const EdgeSplash& e, int x, int y) { return code(e.edge(), x, y) == 255 && code(e.angle(), x, y) == 255; }
inline double mean(const Image& mask) {
  double sum = 0;
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) sum += code(mask, x, y) / 255.0;
  }
  return sum / mask.width() / mask.height();
}

/// A depth field that the scalar passes read: not held to [0, 1].
struct Field {
  TextureData texture;
  Field(int width, int height, Address rule, const DepthOf& value) : texture(plane_of(width, height, value), rule, rule) {}
  const Texture& view() const { return texture.view(); }
};
/// The published sums at a pixel, in the number N.
template <class N>
scalar::Gradient<N> published_gradient(int thickness, const Field& depth, int x, int y) {
  PublishedSplashUniforms u{};
  u.thickness = thickness;
  return scalar::gradient_as_published<N>(u, depth.view(), N(static_cast<float>(x)), N(static_cast<float>(y)));
}
/// The corrected sums of distances 1 / d at a fixed reach.
template <class N>
scalar::Gradient<N> corrected_gradient(int reach, const Field& inverse, int x, int y) {
  SplashUniforms u{};
  u.depth_scale = 1;
  u.reach_min = u.reach_max = static_cast<float>(reach);
  return scalar::sobel(scalar::taps_corrected<N>(u, inverse.view(), N(static_cast<float>(x)), N(static_cast<float>(y))));
}

}  // namespace rainref::edge_splash
