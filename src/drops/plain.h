// The scalar evaluations of this room's passes; a namespace of their own, like puddle::scalar.
#pragma once

#include "drops/records.h"
#include "drops/uniforms.h"
#include "math/plain.h"

namespace rainref::drops::scalar {
using namespace rainref::plain;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "drops/integrate.pass.h"
#include "drops/merge.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::drops::scalar
