// The scalar evaluations of integrate and merge: Plain, Enclosure and Perturbed. A namespace of their own, so that argument types of this
// room do not pull them into the lanes.
#pragma once

#include "drops/records.h"
#include "drops/uniforms.h"
#include "math/perturbed.h"
#include "math/enclosure.h"
#include "math/plain.h"
#include "math/rearranged.h"

namespace rainref::drops::scalar {
using namespace rainref::plain;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "drops/integrate.pass.h"
#include "drops/merge.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::drops::scalar
