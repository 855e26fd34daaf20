// Small glass, chosen maps and single pixels for the tests of this room.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/error_of.h"
#include "image/texture.h"
#include "rainref/executor.h"
#include "rainref/rainy_glass.h"
#include "rainy_glass/host.h"
#include "rainy_glass/scalar.h"
#include "settings.h"

namespace rainref::rainy_glass::test {

using Single = scalar::Scalar<float>;
using Double = scalar::Scalar<double>;

constexpr double pi = 3.14159265358979323846;

inline const parallel::Executor& executor() {
  static const parallel::Executor one(1);
  return one;
}

inline Settings settings(Variant variant, int width, int height) {
  Settings s = rainref::test::rainy_glass_settings();
  s.variant = variant;
  s.width = width;
  s.height = height;
  s.seed = 3;
  s.map_size = 64;
  s.map_storage = variant == Variant::corrected ? Format::rgba16f : Format::rgba8;
  s.droplet_count = 60;
  s.largest_droplet = 0.08;
  s.smallest_droplet = 0.02;
  s.trail_count = 6;
  s.trail_half_width = 0.03;
  s.flow_cells = 4;
  s.drop_tile = s.rivulet_tile = 0.2;
  if (variant == Variant::as_published) {
    s.rain_amount = 1;
    s.drop_period = s.flow_period = 1;
    s.flow_strength = 1;
    s.rivulet_speed = 0;
  }
  return s;
}

/// As published, with values of its own for every reading of the shipped shader.
inline Settings shipped_settings(int width, int height) {
  Settings s = settings(Variant::as_published, width, height);
  s.remap_first = s.signed_offset = s.squared_weight = true;
  s.flow_across = {-0.1, 0.2};
  s.flow_along = {0.1, 3};
  s.fade_from = 0.6;
  s.map_turn_deg = 20;
  s.rivulet_turn_deg = -35;
  s.tint = {0.88, 0.92, 0.9};
  s.rivulet_speed = 0.5;
  s.rivulet_amount = 1.4;
  return s;
}

/// A scene that tells every texel from its neighbours, 2 to 10 m away.
inline Surroundings surroundings(const Settings& s) {
  Surroundings around;
  around.colour = Image(Format::rgba32f, s.width, s.height);
  around.depth = Image(Format::r32f, s.width, s.height);
  for (int y = 0; y < s.height; ++y) {
    for (int x = 0; x < s.width; ++x) {
      float* c = around.colour.row<float>(y) + 4 * x;
      for (int k = 0; k < 4; ++k) c[k] = 0.05f * static_cast<float>(1 + (7 * x + 13 * y + 5 * k) % 17);
      around.depth.row<float>(y)[x] = static_cast<float>(2 + (x + 2 * y) % 9);
    }
  }
  if (s.use_probe) {
    around.probe = Image(Format::rgba32f, 16, 8);
    for (int y = 0; y < 8; ++y) {
      for (int i = 0; i < 64; ++i) around.probe.row<float>(y)[i] = 0.1f * static_cast<float>(1 + (3 * i + 5 * y) % 11);
    }
  }
  return around;
}

inline Image uniform_image(Format format, int width, int height, float r, float g, float b, float a) {
  Image image(format, width, height);
  const float texel[] = {r, g, b, a};
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < 4 * width; ++i) image.row<float>(y)[i] = texel[i % 4];
  }
  return image;
}

/// Decoded channels of a map's texel.
inline std::vector<float> texels(const Image& map) {
  const TextureData t(map, Address::clamp, Address::clamp);
  return {t.view().texels, t.view().texels + static_cast<std::size_t>(map.width()) * map.height() * 4};
}

/// One pixel of corrected or published glass before chosen maps, in double, from the middle of a picture of 101 x 101.
struct Pixel {
  Settings settings = rainref::test::rainy_glass_settings();
  TextureData raindrops, rivulets, scene, near;
  RainOnGlassUniforms uniforms{};
  scalar::GlassPixel<Double> at{};
  int column = 50, row = 50;

  /// Maps of one value each: r g b a. The scene's red is u, its green v, at infinity.
  Pixel(Variant variant, std::vector<float> drop, std::vector<float> rivulet, double time = 0)
      : settings(test::settings(variant, 101, 101)) {
    raindrops = TextureData(std::move(drop), 4, 1, 1, Address::repeat, Address::repeat);
    rivulets = TextureData(std::move(rivulet), 4, 1, 1, Address::repeat, Address::repeat);
    std::vector<float> ramp;
    for (int y = 0; y < 101; ++y) {
      for (int x = 0; x < 101; ++x)
        ramp.insert(ramp.end(), {(static_cast<float>(x) + 0.5f) / 101, (static_cast<float>(y) + 0.5f) / 101, 0, 1});
    }
    scene = TextureData(ramp, 4, 101, 101, Address::clamp, Address::clamp);
    near = TextureData(std::vector<float>(1, 1e9f), 1, 1, 1, Address::clamp, Address::clamp);
    settings.fps = 1000;
    uniforms = rain_on_glass_uniforms(settings, static_cast<int>(std::lround(time * 1000)), code_of(settings, settings.map_storage),
                                      code_of(settings, settings.map_storage));
    uniforms.rain_to[0] = 0, uniforms.rain_to[1] = uniforms.rain_to[2] = 1;  // onto glass of normal +z
    at = {Double(0.0f),
          Double(0.0f),
          Double(1.0f),
          Double(1.0f),
          scalar::Vec3<Double>(Double(0.0f), Double(0.0f), Double(1.0f)),
          scalar::Vec3<Double>(Double(-1.0f), Double(-1.0f), Double(0.0f)),
          Double(1e9f)};
  }
  void set_normal(double x, double y, double z) { at.normal = scalar::Vec3<Double>(Double(x), Double(y), Double(z)); }
  scalar::Vec3<Double> colour() const {
    const scalar::GlassMaps<Texture, Texture, Texture> maps{&raindrops.view(), &rivulets.view(), &scene.view(), &near.view(), nullptr};
    return settings.variant == Variant::corrected ? scalar::rain_on_glass_corrected<Double>(uniforms, maps, at, column, row)
                                                  : scalar::rain_on_glass_as_published<Double>(uniforms, maps, at, column, row);
  }
  /// By how many pictures the lookup is moved; {-1.5, -1.5} where the scene's own texel shows.
  std::array<double, 2> moved() const {
    const auto c = colour();
    return {c.x.v - 0.5, c.y.v - 0.5};
  }
};

}  // namespace rainref::rainy_glass::test
