// Bounds of the water's height and slope, which allow the march of surface_hit long steps.
#pragma once

#include <string>

#include "capture/pass_case.h"
#include "image/texture.h"
#include "puddle/uniforms.h"
#include "rainref/executor.h"
#include "rainref/puddle.h"

namespace rainref::puddle {

/// The texture `bounds` of surface_hit, corrected: a texel for each block of 32 x 32 cells. Channel 0: no height in the block or in its
/// eight neighbours is above this, or below its negative [m]. Channel 1: no slope there is above this [1]. Also sets the uniforms that
/// belong to it, and those that bound all of the water. `decoded` holds stored values, row-major, of the corrected wave; heights beyond its
/// edge are 0.
TextureData surface_bounds(const Settings& settings, const float* decoded, const parallel::Executor& executor,
                           SurfaceHitUniforms& uniforms);

/// Checks whether the texture `bounds` and the uniforms of a run of surface_hit, corrected, hold for its wave. Returns "", or the first
/// place where the water is higher or steeper than they say, for example because they belong to another frame.
std::string doubt_bounds(const capture::PassCase& c);

}  // namespace rainref::puddle
