// Options of pictures: how the linear picture that an effect's display reads is shown, other than by that pass.
#pragma once

#include <cstdint>
#include <vector>

#include "effect/instance.h"
#include "effect/run_memory.h"
#include "rainref/executor.h"
#include "rainref/image.h"
#include "scene/config.h"

namespace rainref::simulation {

/// Keys `picture.*`. All off, a picture is what the pass display gives.
struct Development {
  double shoulder = 1, desaturation = 0.15;  ///< simulation/tone_curve.h
  double bloom = 0;                          ///< share of the light that is scattered
  double bloom_threshold = 0;                ///< light above it is
  double bloom_radius = 0.1;                 ///< of the widest blur, heights of the picture
  bool dither = false;
  bool has_layer = false;  ///< EXR files hold the drops by themselves, too

  bool is_on() const { return shoulder < 1 || bloom > 0 || dither; }
};

std::vector<scene::Parameter> development_parameters();
/// Of a configuration without these keys: all off.
Development development_from(const scene::Config& config);
/// Adds what developed() takes.
void hold_development(effect::RunMemory& memory, const Development& options, int samples);

/// rgba8 of 1/n of the radiance's size, alpha 1, row 0 = bottom. In this order: exposure; a share `bloom` of the light above the threshold
/// scattered; vignette; the tone curve; light as the display's code shows it; the mean of n x n samples and more (picture_of_means); sRGB
/// code, nearest or dithered by a hash of seed, frame and pixel. What is no number or below 0 is 0, and radiance ends at 65504.
Image developed(const effect::Display& display, const Development& options, int n, std::uint64_t seed, int frame,
                const parallel::Executor& executor);

}  // namespace rainref::simulation
