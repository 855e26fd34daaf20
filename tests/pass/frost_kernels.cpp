// The made-up passes of frost.pass.h, compiled once for each SIMD target.
#include "image/texture.h"
#include "pass/frost.pass.h"
#include "pass/run.h"

#define RAINREF_KERNELS "pass/frost_kernels.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"
#include "pass/rows-inl.h"

RAINREF_TARGET_BEGIN(frost)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "image/sampling-inl.h"
#include "pass/frost.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA
RAINREF_PASS_ROWS(GrowPass)
RAINREF_PASS_ROWS(ShinePass)
RAINREF_TARGET_END(frost)

#if RAINREF_ONCE
RAINREF_PASS_DISPATCH(frost, GrowPass)
RAINREF_PASS_DISPATCH(frost, ShinePass)
#endif
