// The bakes in lanes; compiled once for each SIMD target.
#include "pass/run.h"
#include "rainy_glass/bake.pass.h"

#define RAINREF_KERNELS "rainy_glass/kernels_bake.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"
#include "pass/rows-inl.h"

RAINREF_TARGET_BEGIN(rainy_glass)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "rainy_glass/bake.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA
RAINREF_PASS_ROWS(BakeRaindropsPass)
RAINREF_PASS_ROWS(BakeRivuletsPass)
RAINREF_TARGET_END(rainy_glass)

#if RAINREF_ONCE
RAINREF_PASS_DISPATCH(rainy_glass, BakeRaindropsPass)
RAINREF_PASS_DISPATCH(rainy_glass, BakeRivuletsPass)
#endif
