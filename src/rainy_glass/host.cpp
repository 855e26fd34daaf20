#include "rainy_glass/host.h"

#include <cmath>

#include <fmt/format.h>

#include "base/floating_point.h"
#include "image/half_image.h"
#include "image/seam.h"
#include "math/constants.h"
#include "math/half.h"
#include "math/real64.h"
#include "math/unorm.h"
#include "rainref/error.h"

namespace rainref::rainy_glass {
namespace {

using scene::Vector3;

bool corrected(const Settings& s) { return s.variant == Variant::corrected; }
Vector3 vector(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }
void put(const Vector3& v, float (&out)[3]) {
  for (int k = 0; k < 3; ++k) out[k] = static_cast<float>(v[k]);
}
double fraction(double x) { return x - std::floor(x); }
/// Cosine and sine.
void put_turn(double degrees, float (&out)[2]) {
  const Real64 angle(degrees * degree);
  out[0] = static_cast<float>(cos_real(angle).v);
  out[1] = static_cast<float>(sin_real(angle).v);
}

}  // namespace

Code code_of(const Settings& s, Format stored) {
  if (corrected(s) && stored == Format::rgba8) return {static_cast<double>(128.0f / 255.0f), static_cast<double>(127.0f / 255.0f)};
  return {0.5, 0.5};
}

scene::Camera camera(const Settings& s) {
  return {vector(s.camera_position), vector(s.camera_target), vector(s.camera_up), s.vertical_fov_deg};
}

void check(const Settings& s) {
  if (s.map_storage != Format::rgba8 && s.map_storage != Format::rgba16f)
    throw Error(ExitCode::usage, "maps.storage: expected rgba8 or rgba16f");
  const auto positive = [](double x, const char* key) {
    if (!(x > 0)) throw Error(ExitCode::usage, fmt::format("{}: expected more than 0, found {}", key, x));
  };
  positive(s.drop_tile, "glass.drop_tile");
  positive(s.rivulet_tile, "glass.rivulet_tile");
  positive(s.distance, "glass.distance");
  positive(s.radius, "glass.radius");
  positive(s.drop_period, "rain.drop_period");
  positive(s.flow_period, "rain.flow_period");
  positive(s.rim, "rain.rim");
  if (!(s.smallest_droplet > 0 && s.smallest_droplet <= s.largest_droplet)) {
    throw Error(ExitCode::usage,
                fmt::format("maps.smallest_droplet: expected a radius above 0 and at most maps.largest_droplet = {}, found {}",
                            s.largest_droplet, s.smallest_droplet));
  }
  if (!(s.impact > 0 && s.impact < 1))
    throw Error(ExitCode::usage, fmt::format("rain.impact: expected a share between 0 and 1, found {}", s.impact));
  if (!(s.fade_from >= 0 && s.fade_from < 1))
    throw Error(ExitCode::usage, fmt::format("rain.fade_from: expected a share below 1, found {}", s.fade_from));
  camera(s).basis();  // throws for an invalid camera
}

namespace {

void expect_size(const Settings& s, const Image& image, const char* key) {
  if (image.width() == s.width && image.height() == s.height) return;
  throw Error(ExitCode::usage, fmt::format("{}: expected {}x{} like the picture and scene.image, found {}x{}", key, s.width, s.height,
                                           image.width(), image.height()));
}

}  // namespace

void check_scene(const Settings& s, const Image& colour, const Image& depth) {
  expect_size(s, colour, "scene.image");
  if (corrected(s)) {
    expect_size(s, depth, "scene.depth_image");
    for (int y = 0; y < s.height; ++y) {
      for (int x = 0; x < s.width; ++x) {
        const float d = depth.row<float>(y)[x];
        if (!(d >= 0))
          throw Error(
              ExitCode::usage,
              fmt::format("scene.depth_image: expected depths of 0 m or more, found {} at column {}, row {} from the bottom", d, x, y));
      }
    }
  }
}
void check(const Settings& s, const Surroundings& around) {
  check_scene(s, around.colour, around.depth);
  if (s.shape == Shape::image) expect_size(s, around.normals, "glass.normal_image");
  if (s.use_probe && around.probe.empty()) throw Error(ExitCode::usage, "glass.background: 'probe' needs a panorama, found none");
  for (const auto& [map, key] :
       {std::pair{&around.raindrops, "maps.raindrops_image"}, std::pair{&around.rivulets, "maps.rivulets_image"}}) {
    if (!map->empty() && map->channels() != 4)
      throw Error(ExitCode::usage, fmt::format("{}: expected four channels, found {}", key, map->channels()));
  }
}

BakeRaindropsUniforms bake_raindrops_uniforms(const Settings& s, int droplet_count) {
  BakeRaindropsUniforms u{};
  u.inverse_size[0] = u.inverse_size[1] = static_cast<float>(1.0 / s.map_size);
  u.droplet_count = droplet_count;
  // A cap of radius r and height h = r / largest has slope 2 h / r at its rim; this makes it the tangent of the contact angle.
  const Real64 angle(s.contact_angle_deg * degree);
  u.normal_scale = static_cast<float>(0.5 * s.largest_droplet * (sin_real(angle) / cos_real(angle)).v);
  const Code c = code_of(s, s.map_storage);
  u.neutral = static_cast<float>(c.neutral);
  u.span = static_cast<float>(c.span);
  return u;
}
BakeRivuletsUniforms bake_rivulets_uniforms(const Settings& s, int trail_count) {
  const BakeRaindropsUniforms d = bake_raindrops_uniforms(s, 0);
  BakeRivuletsUniforms u{};
  u.inverse_size[0] = u.inverse_size[1] = d.inverse_size[0];
  u.trail_count = trail_count;
  u.normal_scale = static_cast<float>(d.normal_scale * s.trail_half_width / s.largest_droplet);
  u.neutral = d.neutral;
  u.span = d.span;
  u.flow_cells = s.flow_cells;
  u.flow_gain = static_cast<float>(s.flow_gain);
  return u;
}

RainOnGlassUniforms rain_on_glass_uniforms(const Settings& s, int frame, Code raindrops, Code rivulets) {
  RainOnGlassUniforms u{};
  const double time = frame / s.fps;
  u.pixel[0] = static_cast<float>(1.0 / s.width);
  u.pixel[1] = static_cast<float>(1.0 / s.height);
  u.time = static_cast<float>(time);
  u.rain_amount = static_cast<float>(s.rain_amount);
  u.drop_tiles = static_cast<float>(1 / s.drop_tile);
  u.rivulet_tiles = static_cast<float>(1 / s.rivulet_tile);
  u.drop_rate = static_cast<float>(1 / s.drop_period);
  u.flow_rate = static_cast<float>(1 / s.flow_period);
  u.flow_strength = static_cast<float>(s.flow_strength);
  u.distortion = static_cast<float>(s.distortion);
  u.use_probe = s.use_probe;
  u.probe_level = static_cast<float>(s.probe_level);
  const auto phase = [](double x) { return std::min(static_cast<float>(fraction(x)), 0x1.fffffep-1f); };  // not rounded up to 1
  u.drop_phase = phase(time / s.drop_period);
  u.flow_phase = phase(time / s.flow_period);
  u.scroll = phase(time * s.rivulet_speed / s.rivulet_tile);
  u.run_strength = static_cast<float>(s.run * s.rivulet_speed * s.flow_period / s.rivulet_tile);
  u.drop_neutral = static_cast<float>(raindrops.neutral);
  u.drop_scale = static_cast<float>(1 / raindrops.span);
  u.rivulet_neutral = static_cast<float>(rivulets.neutral);
  u.rivulet_scale = static_cast<float>(1 / rivulets.span);
  u.sharpness = static_cast<float>(1 / s.rim);
  u.impact = static_cast<float>(s.impact);
  u.bend = static_cast<float>(s.water_ior - 1);
  u.rivulet_amount = static_cast<float>(s.rivulet_amount);
  const scene::Camera eye = camera(s);
  const auto basis = eye.basis();
  // Rain falls with the wind toward the glass: d = -wind n0 - fall up. Relative to the rain on upright glass that faces it.
  const Vector3 n0 = facing(s);
  put(n0 + Vector3(0, s.fall_speed / std::max(s.wind, 0.1), 0), u.rain_to);
  put(basis.right, u.right);
  put(basis.up, u.up);
  put(basis.forward, u.forward);
  put_turn(s.map_turn_deg, u.turn);
  put_turn(s.map_turn_deg + s.rivulet_turn_deg, u.rivulet_turn);
  const std::array<double, 2> flows[] = {s.flow_across, s.flow_along};
  for (int k = 0; k < 2; ++k) {
    u.flow_from[k] = static_cast<float>(flows[k][0]);
    u.flow_span[k] = static_cast<float>(flows[k][1] - flows[k][0]);
  }
  put(vector(s.tint), u.tint);
  u.fade_rate = static_cast<float>(1 / (1 - s.fade_from));
  u.remap_first = s.remap_first;
  u.signed_offset = s.signed_offset;
  u.squared_weight = s.squared_weight;
  u.half_height = static_cast<float>(eye.half_height());
  u.half_width = static_cast<float>(eye.half_height() * s.width / s.height);
  return u;
}

Image colour_as_half(const Image& image, const Rows& rows) { return as_half(image, rows, 0, 65504); }

Image stored_map(const Image& map, Format format) {
  const TextureData decoded(map, Address::clamp, Address::clamp);
  Image out(format, map.width(), map.height());
  const float* in = decoded.view().texels;
  for (int y = 0; y < map.height(); ++y) {
    for (int i = 0; i < 4 * map.width(); ++i, ++in) {
      if (format == Format::rgba8)
        out.row<Unorm8>(y)[i] = to_unorm8(*in, Rounding::rne);
      else
        out.row<Half>(y)[i] = to_half(*in);
    }
  }
  return out;
}

double seam(const Image& map) {
  const FloatingPointGuard guard;
  return seam_ratio(map);
}

}  // namespace rainref::rainy_glass
