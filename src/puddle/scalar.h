// The scalar evaluations of the puddle's passes: Scalar, Enclosure and Perturbed. They have their own namespace, so that argument types of
// this room do not pull them into the lanes.
#pragma once

#include "image/footprint.h"
#include "image/texture.h"
#include "math/numbers.h"
#include "puddle/display.pass.h"
#include "puddle/raindrops.pass.h"
#include "puddle/shade.pass.h"
#include "puddle/surface_hit.pass.h"
#include "puddle/uniforms.h"
#include "puddle/wave_step.pass.h"

namespace rainref::puddle::scalar {
using namespace rainref::scalar;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "math/optics-inl.h"
#include "image/sampling_numbers-inl.h"
#include "image/environment-inl.h"
#include "puddle/raindrops.pass.h"
#include "puddle/wave_step.pass.h"
#include "puddle/surface_hit.pass.h"
#include "puddle/shade.pass.h"
#include "puddle/display.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::puddle::scalar
