// The text of display with every number but lanes: Plain, Enclosure and Perturbed; like puddle::scalar.
#pragma once

#include "math/perturbed.h"
#include "math/enclosure.h"
#include "math/plain.h"
#include "math/rearranged.h"
#include "pass/display.pass.h"

namespace rainref::pass::scalar {
using namespace rainref::plain;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "math/optics-inl.h"
#include "pass/display.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::pass::scalar
