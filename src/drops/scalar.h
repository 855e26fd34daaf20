// The texts of integrate, merge and necks with every number but lanes.
#pragma once

#include "drops/drop_scalar.h"
#include "drops/integrate.pass.h"
#include "drops/merge.pass.h"
#include "drops/necks.pass.h"

namespace rainref::drops::scalar {

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "drops/integrate.pass.h"
#include "drops/merge.pass.h"
#include "drops/necks.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::drops::scalar
