// What the puddle's passes take besides images: uniform blocks and the drop record. Sizes are multiples of 16 bytes,
// nothing straddles a 16-byte row, and every gap is a named padding member, so the bytes serve every GPU language.
#pragma once

#include <cstdint>

namespace rainref::puddle {

/// One drop as wave_step takes it: a crater around (x, y).
struct Drop {
  float x, y;       ///< centre [texels], texel centres at k + 1/2
  float amplitude;  ///< as-published: strength times activation; corrected: height at the centre in stored units
  float radius;     ///< [texels]; nothing is added at this distance or beyond
};

struct RaindropsUniforms {
  float time;            ///< n / fps, rounded once [s]
  float rain_speed;      ///< pulses a second [1/s]
  float drop_intensity;  ///< [1]
  float padding0;
  float width, height;  ///< size of the wave buffer [texels]
  std::int32_t drop_count;
  std::int32_t padding1;
};

/// raindrops, corrected: with the records CountThreshold and the Drop records of the craters all that it depends on.
struct RainfallUniforms {
  std::uint32_t seed[2];        ///< low word, high word
  std::uint32_t step;           ///< wave steps made before, modulo 2^32
  std::int32_t first_count;     ///< the count of a word below the first threshold
  std::uint32_t columns, rows;  ///< cells of the wave
  std::int32_t boundary;        ///< 0 reflecting, 1 periodic, 2 fixed
  std::int32_t threshold_count;
  std::uint32_t shelter_columns, shelter_rows;  ///< of the records ShelterCell; 0: it rains everywhere
  std::int32_t object_count;                    ///< records of objects in this step
  std::int32_t padding0;
};
/// A word not below k thresholds draws first_count + k drops.
struct CountThreshold {
  std::uint32_t threshold;
};

/// Rain over a cell of the shelter.
struct ShelterCell {
  std::uint32_t open;  ///< of 65536 drops so many fall
};

struct WaveStepUniforms {
  float damping;     ///< as-published: factor of the new level; corrected: gamma of one step
  float step;        ///< as-published: offset of the neighbours [texels]
  float courant_sq;  ///< corrected: (c dt / dx)^2 (1 + gamma) / 2
  std::int32_t drop_count;
  float rest;         ///< stored value of level water
  float rim_damping;  ///< corrected: share of the wave that the rim takes in a step at the edge itself; 0: no rim
  float rim_inverse;  ///< corrected: 1 / width of the rim [1/texel]
  float padding0;
  float size[2];  ///< corrected: columns and rows of the wave [texels]
  float padding1, padding2;
};

struct CameraUniforms {
  float position[3];
  float pixel_scale;  ///< height of a pixel on the image plane at distance 1
  float right[3];
  float plane_left;  ///< x of the image plane's left edge at distance 1
  float up[3];
  float plane_bottom;  ///< y of the image plane's bottom edge at distance 1
  float forward[3];
  float padding0;
};

struct SurfaceHitUniforms {
  CameraUniforms camera;
  float half_size[3];  ///< of the puddle's box; as-published (42, 5, 42)
  float epsilon;       ///< distance that counts as a hit
  float texel[2];      ///< 1 / size of the wave buffer
  std::int32_t max_steps;
  float normal_gain;                ///< as-published 2.5; corrected: metres of height per stored unit over twice the cell size
  float height_scale, height_bias;  ///< corrected: height = scale * stored + bias [m]
  float surface_top;                ///< corrected: no height is above this [m]
  float surface_slope;              ///< corrected: no slope is above this [1]
  float inverse_size[2];            ///< corrected: 1 / extent of the puddle in x and z [1/m]
  float bounds_scale[2];            ///< corrected: texture coordinates of `bounds` to one of the water
  float bounds_reach;               ///< corrected: distance around a point for which its texel of `bounds` holds [m]
  float padding0, padding1, padding2;
};

struct GroundNoiseUniforms {
  CameraUniforms camera;
  float puddle_depth;
  float padding0, padding1, padding2;
};

struct ShadeUniforms {
  CameraUniforms camera;
  float tint[3];
  float reflectivity;
  float rotation[2];  ///< cosine and sine of env_rotation
  float ground_scale;
  float water_turbidity;
  float puddle_depth;
  float fog_depth;
  std::int32_t use_checkerboard;
  std::int32_t environment_is_cube;
  float ambient[3];        ///< corrected: radiance of a white diffuse ground under the environment
  float gloss_level;       ///< corrected: mip level of the environment that the wet ground mirrors
  float inverse_size[2];   ///< corrected: 1 / extent of the puddle in x and z [1/m]
  float shore_width;       ///< corrected: water depth over which wet ground turns into water [m]
  float ground_footprint;  ///< corrected: texels of the ground image that a pixel covers at distance 1
  float fog_colour[3];     ///< corrected
  std::int32_t exact_fresnel;
  float wetness;           ///< corrected: reflectance of the wet ground over that of water
  float background_level;  ///< corrected: mip level of the environment behind the scene
  float mirror_level;      ///< corrected: mip level of the environment in the water
  float ground_reach;      ///< corrected: extents of the puddle over which the ground turns into the environment's; 0: never
};

struct DisplayUniforms {
  float vignette;
  float exposure;  ///< corrected: factor of the radiance
  float width, height;
};

static_assert(sizeof(Drop) == 16 && sizeof(RaindropsUniforms) == 32 && sizeof(RainfallUniforms) == 48 && sizeof(WaveStepUniforms) == 48);
static_assert(sizeof(CameraUniforms) == 64 && sizeof(SurfaceHitUniforms) == 144 && sizeof(GroundNoiseUniforms) == 80);
static_assert(sizeof(ShadeUniforms) == 176 && sizeof(DisplayUniforms) == 16);

}  // namespace rainref::puddle
