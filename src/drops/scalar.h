// The texts of integrate and merge with every number but lanes.
#pragma once

#include "drops/drop_scalar.h"
#include "drops/integrate.pass.h"
#include "drops/merge.pass.h"

namespace rainref::drops::scalar {

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "drops/integrate.pass.h"
#include "drops/merge.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::drops::scalar
