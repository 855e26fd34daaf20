// The scalar evaluations of splat, in a namespace of their own, so that argument types of this room do not pull them into the
// lanes.
#pragma once

#include "drops/records.h"
#include "drops/splat_uniforms.h"
#include "math/plain.h"

namespace rainref::drops::scalar {
using namespace rainref::plain;

#define RAINREF_FN inline
#include "drops/splat.pass.h"
#undef RAINREF_FN

}  // namespace rainref::drops::scalar
