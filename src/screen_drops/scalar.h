// The scalar evaluations of the passes of screen_drops: Scalar, Enclosure and Perturbed. They have their own namespace, so that argument
// types of this room do not pull them into the lanes.
#pragma once

#include "image/footprint.h"
#include "image/texture.h"
#include "math/in_parts.h"
#include "math/numbers.h"
#include "random/draws.h"
#include "screen_drops/background.pass.h"
#include "screen_drops/cells.pass.h"
#include "screen_drops/drops.pass.h"
#include "screen_drops/uniforms.h"

namespace rainref::screen_drops::scalar {
using namespace rainref::scalar;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "math/optics-inl.h"
#include "image/sampling_numbers-inl.h"
#include "screen_drops/background.pass.h"
#include "screen_drops/cells.pass.h"
#include "math/in_parts-inl.h"
#include "screen_drops/drops.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::screen_drops::scalar
