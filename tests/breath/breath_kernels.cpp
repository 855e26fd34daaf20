// Both passes in lanes; compiled once for each SIMD target.
#include "breath/condense.pass.h"
#include "breath/veil.pass.h"
#include "pass/run.h"

#define RAINREF_KERNELS "breath/breath_kernels.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"
#include "pass/rows-inl.h"

RAINREF_TARGET_BEGIN(breath)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#include "breath/condense.pass.h"
#include "breath/veil.pass.h"
#undef RAINREF_FN
RAINREF_PASS_ROWS(CondensePass)
RAINREF_PASS_ROWS(VeilPass)
RAINREF_TARGET_END(breath)

#if RAINREF_ONCE
RAINREF_PASS_DISPATCH(breath, CondensePass)
RAINREF_PASS_DISPATCH(breath, VeilPass)
#endif
