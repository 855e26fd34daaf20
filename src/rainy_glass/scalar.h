// The scalar evaluations of the passes of rainy_glass: Scalar, Enclosure and Perturbed, for the oracle, the tests and the judge. They have
// their own namespace, so that argument types of this room do not pull them into the lanes.
#pragma once

#include "image/footprint.h"
#include "image/texture.h"
#include "math/numbers.h"
#include "rainy_glass/bake.pass.h"
#include "rainy_glass/rain_on_glass.pass.h"
#include "rainy_glass/uniforms.h"

namespace rainref::rainy_glass::scalar {
using namespace rainref::scalar;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "math/optics-inl.h"
#include "image/sampling_numbers-inl.h"
#include "image/environment-inl.h"
#include "rainy_glass/bake.pass.h"
#include "rainy_glass/rain_on_glass.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::rainy_glass::scalar
