// The scalar evaluations of blur_pyramid: Scalar, Enclosure and Perturbed. They have their own namespace, so that argument types of this
// room do not pull them into the lanes.
#pragma once

#include "blur_pyramid/blur_pyramid.pass.h"
#include "image/texture.h"
#include "math/numbers.h"

namespace rainref::blur_pyramid::scalar {
using namespace rainref::scalar;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "math/optics-inl.h"
#include "blur_pyramid/blur_pyramid.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::blur_pyramid::scalar
