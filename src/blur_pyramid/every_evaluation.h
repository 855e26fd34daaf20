// The text of blur_pyramid with every number but lanes: Plain, Enclosure and Perturbed; like puddle::every.
#pragma once

#include "blur_pyramid/uniforms.h"
#include "math/perturbed.h"
#include "math/enclosure.h"
#include "math/plain.h"

namespace rainref::blur_pyramid::every {
using namespace rainref::plain;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "math/optics-inl.h"
#include "blur_pyramid/blur_pyramid.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::blur_pyramid::every
