#include "puddle/host.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "math/real64.h"
#include "rainref/error.h"
#include "scene/camera.h"

namespace rainref::puddle {
namespace {

constexpr double stability_limit = 0x1.6a09e667f3bcdp-1;   // sqrt(1/2): five-point leapfrog in two dimensions
constexpr double rim_echo = 1e-3;                          // remaining height of a normally incident wave after the rim and the wall
constexpr double box_half_side = 42, box_half_height = 5;  // the article's box of 84 x 10 x 84

bool corrected(const Settings& s) { return s.variant == Variant::corrected; }

template <class Vector>
void put(const Vector& from, float (&to)[3]) {
  for (int k = 0; k < 3; ++k) to[k] = static_cast<float>(from[k]);
}

}  // namespace

std::array<int, 2> wave_size(const Settings& s) { return corrected(s) ? s.grid : std::array<int, 2>{s.width, s.height}; }

Encoding encoding(const Settings& s) {
  if (!corrected(s)) return {2, -1, 0.5f};
  if (s.storage != Format::rgba8) return {1, 0, 0.0f};
  // Level water is code 128, so it is stored exactly.
  const float rest = 128.0f / 255.0f;
  return {2 * rgba8_range, -2 * rgba8_range * static_cast<double>(rest), rest};
}

double gamma_of_step(const Settings& s) {
  // The published damping is a factor of the energy in a frame of 1/60 s.
  return corrected(s) ? pow_real(Real64(s.damping), Real64(60 / s.step_rate)).v : s.damping;
}

double courant_number(const Settings& s) { return corrected(s) ? s.wave_speed / (s.step_rate * s.cell_size) : stability_limit * s.step; }

std::int64_t steps_until(const Settings& s, int frames) {
  if (!corrected(s)) return frames;
  // Exact if the quotient is a whole number, because n * rate is exact and division is correctly rounded.
  return static_cast<std::int64_t>(static_cast<double>(frames) * s.step_rate / s.fps);
}

void check(const Settings& s) {
  const double courant = courant_number(s);
  if (corrected(s) && !(courant <= stability_limit)) {
    throw Error(
        ExitCode::usage,
        fmt::format("puddle.wave_speed / (puddle.step_rate * puddle.cell_size) = {:.6g}: the wave step is unstable above the Courant "
                    "number sqrt(1/2) = 0.707107; raise puddle.step_rate to {:.0f} or more",
                    courant, std::ceil(s.wave_speed / (stability_limit * s.cell_size))));
  }
  camera_uniforms(s);  // throws for an invalid camera
}

RaindropsUniforms raindrops_uniforms(const Settings& s, int frame) {
  RaindropsUniforms u{};
  u.time = static_cast<float>(frame / s.fps);
  u.rain_speed = static_cast<float>(s.rain_speed);
  u.drop_intensity = static_cast<float>(s.drop_intensity);
  u.width = static_cast<float>(s.width);
  u.height = static_cast<float>(s.height);
  u.drop_count = s.drop_count;
  return u;
}

WaveStepUniforms wave_step_uniforms(const Settings& s) {
  WaveStepUniforms u{};
  const double gamma = gamma_of_step(s), courant = courant_number(s);
  u.damping = static_cast<float>(gamma);
  u.step = corrected(s) ? 1.0f : static_cast<float>(s.step);
  u.rest = encoding(s).rest;
  if (corrected(s)) {
    u.courant_sq = static_cast<float>(courant * courant * (1 + gamma) / 2);
    // Above (1 + gamma) / 4, with the rounded gamma, the shortest wave would grow; the two roundings exceed it by less than an ulp.
    if (4.0 * u.courant_sq > 1.0 + u.damping) u.courant_sq = std::nextafter(u.courant_sq, 0.0f);
    if (s.rim_width > 0.5 * s.cell_size) {  // otherwise no cell's centre lies in it
      // A wave fades by exp(-integral of sigma / c) on its way. With sigma = rate depth^2 it fades by rim_echo on the way to the edge and
      // back.
      const double rate = 1.5 * -log_real(Real64(rim_echo)).v * s.wave_speed / s.rim_width;
      u.rim_damping = static_cast<float>(1 - exp_real(Real64(-rate / s.step_rate)).v);
      u.rim_inverse = static_cast<float>(s.cell_size / s.rim_width);
      u.size[0] = static_cast<float>(wave_size(s)[0]);
      u.size[1] = static_cast<float>(wave_size(s)[1]);
    }
  }
  return u;
}

CameraUniforms camera_uniforms(const Settings& s) {
  scene::Camera camera;
  const auto vector = [](const std::array<double, 3>& a) { return scene::Vector3(a[0], a[1], a[2]); };
  camera.position = vector(s.camera_position);
  camera.target = vector(s.camera_target);
  camera.up = vector(s.camera_up);
  camera.vertical_fov_deg = s.vertical_fov_deg;
  const scene::Camera::Basis basis = camera.basis();
  const double half = camera.half_height();
  CameraUniforms u{};
  put(camera.position, u.position);
  put(basis.right, u.right);
  put(basis.up, u.up);
  put(basis.forward, u.forward);
  u.pixel_scale = static_cast<float>(2 * half / s.height);
  u.plane_left = static_cast<float>(-half * s.width / s.height);
  u.plane_bottom = static_cast<float>(-half);
  return u;
}

SurfaceHitUniforms surface_hit_uniforms(const Settings& s) {
  SurfaceHitUniforms u{};
  u.camera = camera_uniforms(s);
  const auto [columns, rows] = wave_size(s);
  u.texel[0] = static_cast<float>(1.0 / columns);
  u.texel[1] = static_cast<float>(1.0 / rows);
  u.max_steps = s.max_steps;
  const Encoding e = encoding(s);
  u.height_scale = static_cast<float>(e.scale);
  u.height_bias = static_cast<float>(e.bias);
  if (corrected(s)) {
    u.half_size[0] = static_cast<float>(0.5 * columns * s.cell_size);
    u.half_size[2] = static_cast<float>(0.5 * rows * s.cell_size);
    u.inverse_size[0] = static_cast<float>(1 / (columns * s.cell_size));
    u.inverse_size[1] = static_cast<float>(1 / (rows * s.cell_size));
    u.epsilon = 1e-4f;
    u.normal_gain = static_cast<float>(0.5 / s.cell_size);
  } else {
    u.half_size[0] = u.half_size[2] = static_cast<float>(box_half_side);
    u.half_size[1] = static_cast<float>(box_half_height);
    u.epsilon = 1e-3f;
    u.normal_gain = 2.5f;
  }
  return u;
}

GroundNoiseUniforms ground_noise_uniforms(const Settings& s) {
  GroundNoiseUniforms u{};
  u.camera = camera_uniforms(s);
  u.puddle_depth = static_cast<float>(s.puddle_depth);
  return u;
}

ShadeUniforms shade_uniforms(const Settings& s) {
  ShadeUniforms u{};
  u.camera = camera_uniforms(s);
  put(s.tint, u.tint);
  u.reflectivity = static_cast<float>(s.reflectivity);
  u.rotation[0] = static_cast<float>(cos_real(Real64(s.env_rotation)).v);
  u.rotation[1] = static_cast<float>(sin_real(Real64(s.env_rotation)).v);
  u.ground_scale = static_cast<float>(s.ground_scale);
  u.water_turbidity = static_cast<float>(s.water_turbidity);
  u.puddle_depth = static_cast<float>(s.puddle_depth);
  u.fog_depth = static_cast<float>(s.fog_depth);
  u.use_checkerboard = s.use_checkerboard;
  u.inverse_size[0] = static_cast<float>(1 / (s.grid[0] * s.cell_size));
  u.inverse_size[1] = static_cast<float>(1 / (s.grid[1] * s.cell_size));
  u.shore_width = corrected(s) ? static_cast<float>(s.shore_width) : 0.002f;  // as published unused; kept because packs have always
                                                                              // contained it
  u.gloss_level = 4.0f;  // corrected: gloss_level() of the environment, which the caller knows
  u.wetness = 0.45f;
  u.background_level = 0.0f;
  // A pixel of rippled water reflects an area of the environment, not a point.
  u.mirror_level = 1.0f;
  u.ground_reach = corrected(s) ? static_cast<float>(s.ground_reach) : 0.0f;
  u.exact_fresnel = s.exact_fresnel;
  return u;
}

DisplayUniforms display_uniforms(const Settings& s) {
  DisplayUniforms u{};
  u.vignette = static_cast<float>(s.vignette);
  u.exposure = corrected(s) ? static_cast<float>(exp2_real(Real64(s.exposure)).v) : 1.0f;
  u.width = static_cast<float>(s.width);
  u.height = static_cast<float>(s.height);
  return u;
}

float gloss_level(int width, bool is_cube) {
  const double columns = is_cube ? 4.0 * width : width;
  return static_cast<float>(std::max(log_real(Real64(columns / 256)).v / log_real(Real64(2.0)).v, 2.0));
}

float ground_footprint(const Settings& s, int tile_texels) {
  return static_cast<float>(static_cast<double>(camera_uniforms(s).pixel_scale) * s.ground_scale * tile_texels);
}

}  // namespace rainref::puddle
