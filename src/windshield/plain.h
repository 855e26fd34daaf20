// The scalar evaluations of the windshield's passes: for the oracle and the tests. A namespace of their own, so that argument
// types of this room do not pull them into the lanes.
#pragma once

#include "image/texture.h"
#include "math/plain.h"
#include "windshield/composite.pass.h"

namespace rainref::windshield::scalar {
using namespace rainref::plain;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "math/optics-inl.h"
#include "image/sampling-inl.h"
#include "windshield/composite.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::windshield::scalar
