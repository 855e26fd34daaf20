// smear in lanes; compiled once for each SIMD target.
#include "pass/run.h"
#include "windshield/surface/smear.pass.h"

#define RAINREF_KERNELS "windshield/surface/kernels_smear.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"
#include "pass/rows-inl.h"

RAINREF_TARGET_BEGIN(windshield)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "image/sampling-inl.h"
#include "image/sampling_lanes-inl.h"
#include "windshield/surface/wipe_texture.pass.h"
#include "windshield/surface/smear.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA
RAINREF_PASS_ROWS(SmearPass)
RAINREF_TARGET_END(windshield)

#if RAINREF_ONCE
RAINREF_PASS_DISPATCH(windshield, SmearPass)
#endif
