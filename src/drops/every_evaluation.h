// The texts of this room's passes with every number but lanes: Plain, Enclosure and Perturbed; like puddle::every.
#pragma once

#include "drops/records.h"
#include "drops/uniforms.h"
#include "math/perturbed.h"
#include "math/enclosure.h"
#include "math/plain.h"

namespace rainref::drops::every {
using namespace rainref::plain;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "drops/integrate.pass.h"
#include "drops/merge.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::drops::every
