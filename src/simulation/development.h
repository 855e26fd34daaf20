// Options of pictures: other ways than the pass display to show its linear input.
#pragma once

#include <cstdint>
#include <vector>

#include "effect/instance.h"
#include "effect/run_memory.h"
#include "rainref/executor.h"
#include "rainref/image.h"
#include "scene/config.h"

namespace rainref::simulation {

/// Keys `picture.*`. If all are off, the picture is the output of the pass display.
struct Development {
  double shoulder = 1, desaturation = 0.15;  ///< simulation/tone_curve.h
  double bloom = 0;                          ///< share of the light that is scattered
  double bloom_threshold = 0;                ///< only light above this is scattered
  double bloom_radius = 0.1;                 ///< radius of the widest blur [picture heights]
  bool dither = false;
  bool has_layer = false;  ///< EXR files also hold the drops as a layer

  bool is_on() const { return shoulder < 1 || bloom > 0 || dither; }
};

std::vector<scene::Parameter> development_parameters();
/// Reads the options; all are off if the configuration lacks these keys.
Development development_from(const scene::Config& config);
/// Adds the memory of developed().
void hold_development(effect::RunMemory& memory, const Development& options, int samples);

/// rgba8 of 1/n of the radiance's size, alpha 1, row 0 = bottom. In this order: exposure; a share `bloom` of the light above the threshold
/// scattered; vignette; the tone curve; light as the display's code shows it; the mean of n x n and neighbouring samples
/// (picture_of_means); sRGB code, nearest or dithered by a hash of seed, frame and pixel. NaN and negative values become 0, and radiance is
/// clamped to 65504.
Image developed(const effect::Display& display, const Development& options, int n, std::uint64_t seed, int frame,
                const parallel::Executor& executor);

}  // namespace rainref::simulation
