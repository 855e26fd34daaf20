// The text of display for every number type except lanes: Scalar, Enclosure and Perturbed; like puddle::scalar.
#pragma once

#include "math/numbers.h"
#include "pass/display.pass.h"

namespace rainref::pass::scalar {
using namespace rainref::scalar;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "math/optics-inl.h"
#include "pass/display.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::pass::scalar
