// The scalar evaluations of edge_splash: Scalar, Enclosure and Perturbed. They have their own namespace, so that argument types of this
// room do not pull them into the lanes.
#pragma once

#include "edge_splash/splash.pass.h"
#include "image/footprint.h"
#include "image/texture.h"
#include "math/numbers.h"

namespace rainref::edge_splash::scalar {
using namespace rainref::scalar;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "math/half_turn-inl.h"
#include "math/optics-inl.h"
#include "image/sampling_numbers-inl.h"
#include "edge_splash/splash.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::edge_splash::scalar
