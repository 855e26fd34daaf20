// Uniforms that the host computes from the settings alone, in double, each rounded once.
#pragma once

#include <array>

#include "base/memory.h"
#include "puddle/kernels.h"
#include "puddle/uniforms.h"
#include "rainref/puddle.h"

namespace rainref::puddle {

/// Encoding of stored heights: height = scale * stored + bias; `rest` is the stored value of level water.
struct Encoding {
  double scale, bias;
  float rest;
};
/// as-published u = 2 (s - 1/2), corrected metres. An 8-bit corrected wave spans +-rgba8_range.
Encoding encoding(const Settings& settings);
inline constexpr double rgba8_range = 0.02;  ///< [m]

/// Energy kept in one wave step.
double gamma_of_step(const Settings& settings);
double courant_number(const Settings& settings);
/// Wave steps made by the end of frame `frames` - 1.
std::int64_t steps_until(const Settings& settings, int frames);

/// Throws Error(usage) with the first problem for settings that cannot run.
void check(const Settings& settings);

RaindropsUniforms raindrops_uniforms(const Settings& settings, int frame);
WaveStepUniforms wave_step_uniforms(const Settings& settings);
CameraUniforms camera_uniforms(const Settings& settings);
SurfaceHitUniforms surface_hit_uniforms(const Settings& settings);
GroundNoiseUniforms ground_noise_uniforms(const Settings& settings);
ShadeUniforms shade_uniforms(const Settings& settings);
DisplayUniforms display_uniforms(const Settings& settings);

/// ShadeUniforms::gloss_level of the corrected variant, for an environment whose level 0 is `width` texels wide. It is the level with
/// texels of 360/256 degrees, the area that wet asphalt mirrors (chosen by eye: twice as wide it shows as a soft band before the street's
/// own road). It is 2 if that level is finer, so that it stays coarser than the reflection in water.
float gloss_level(int width, bool is_cube);

/// ShadeUniforms::ground_footprint for a tile of this many texels a side.
float ground_footprint(const Settings& settings, int tile_texels);

/// Columns and rows of the wave buffer.
std::array<int, 2> wave_size(const Settings& settings);

/// Columns and rows of the pictures given to a puddle.
struct PictureSizes {
  std::array<int, 2> environment{1024, 512};
  bool has_float_environment = false;  ///< its texels are floats, which are read in place
  std::array<int, 2> ground{0, 0};     ///< 0: asphalt is generated
  std::array<int, 2> shelter{0, 0};
};
PictureSizes sizes_of(const Surroundings& surroundings);

/// Memory of the constructor and of frames, without the pictures, which belong to the caller.
MemoryPeak memory(const Settings& settings, const PictureSizes& sizes = {});
/// Throws Error(usage) if it does not fit.
void check_memory(const Settings& settings, const PictureSizes& sizes = {});

}  // namespace rainref::puddle
