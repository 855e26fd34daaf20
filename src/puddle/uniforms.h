// Uniform blocks of the puddle's passes, and the drop record. Sizes are multiples of 16 bytes, no member crosses a 16-byte row, and every
// gap is a named padding member, so the bytes are valid in every GPU language.
#pragma once

#include <cstdint>

namespace rainref::puddle {

/// One drop for wave_step: a crater around (x, y).
struct Drop {
  float x, y, amplitude, radius;
};

struct RaindropsUniforms {
  float time, rain_speed, drop_intensity, padding0;
  float width, height;
  std::int32_t drop_count, padding1;
};

/// raindrops, corrected: with the records CountThreshold and the Drop records of the craters, these are all its inputs.
struct RainfallUniforms {
  std::uint32_t seed[2], step;
  std::int32_t first_count;
  std::uint32_t columns, rows;
  std::int32_t boundary, threshold_count;
  std::uint32_t shelter_columns, shelter_rows;
  std::int32_t object_count, padding0;
};
/// A word at or above k thresholds draws first_count + k drops.
struct CountThreshold {
  std::uint32_t threshold;
};

/// Rain over one cell of the shelter.
struct ShelterCell {
  std::uint32_t open;
};

struct WaveStepUniforms {
  float damping, step, courant_sq;
  std::int32_t drop_count;
  float rest, rim_damping, rim_inverse, padding0;
  float size[2], padding1, padding2;
};

struct CameraUniforms {
  float position[3], pixel_scale;
  float right[3], plane_left;
  float up[3], plane_bottom;
  float forward[3], padding0;
};

struct SurfaceHitUniforms {
  CameraUniforms camera;
  float half_size[3], epsilon;
  float texel[2];
  std::int32_t max_steps;
  float normal_gain;
  float height_scale, height_bias, surface_top, surface_slope;
  float inverse_size[2], bounds_scale[2];
  float bounds_reach, padding0, padding1, padding2;
};

struct GroundNoiseUniforms {
  CameraUniforms camera;
  float puddle_depth, padding0, padding1, padding2;
};

struct ShadeUniforms {
  CameraUniforms camera;
  float tint[3], reflectivity;
  float rotation[2], ground_scale, water_turbidity;
  float puddle_depth, fog_depth;
  std::int32_t use_checkerboard, environment_is_cube;
  float ambient[3], gloss_level;
  float inverse_size[2], shore_width, ground_footprint;
  float fog_colour[3];
  std::int32_t exact_fresnel;
  float wetness, background_level, mirror_level, ground_reach;
};

struct DisplayUniforms {
  float vignette, exposure, width, height;
};

static_assert(sizeof(Drop) == 16 && sizeof(RaindropsUniforms) == 32 && sizeof(RainfallUniforms) == 48 && sizeof(WaveStepUniforms) == 48);
static_assert(sizeof(CameraUniforms) == 64 && sizeof(SurfaceHitUniforms) == 144 && sizeof(GroundNoiseUniforms) == 80);
static_assert(sizeof(ShadeUniforms) == 176 && sizeof(DisplayUniforms) == 16);

}  // namespace rainref::puddle
