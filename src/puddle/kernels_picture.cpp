// surface_hit, ground_noise, shade and display in lanes; compiled once for each SIMD target.
#include "pass/run.h"
#include "puddle/display.pass.h"
#include "puddle/shade.pass.h"
#include "puddle/surface_hit.pass.h"

#define RAINREF_KERNELS "puddle/kernels_picture.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"
#include "pass/rows-inl.h"

RAINREF_TARGET_BEGIN(puddle)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "math/optics-inl.h"
#include "image/sampling-inl.h"
#include "image/environment-inl.h"
#include "puddle/surface_hit.pass.h"
#include "puddle/shade.pass.h"
#include "puddle/display.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA
RAINREF_PASS_ROWS(SurfaceHitPass)
RAINREF_PASS_ROWS(GroundNoisePass)
RAINREF_PASS_ROWS(ShadePass)
RAINREF_PASS_ROWS(DisplayPass)
RAINREF_TARGET_END(puddle)

#if RAINREF_ONCE
RAINREF_PASS_DISPATCH(puddle, SurfaceHitPass)
RAINREF_PASS_DISPATCH(puddle, GroundNoisePass)
RAINREF_PASS_DISPATCH(puddle, ShadePass)
RAINREF_PASS_DISPATCH(puddle, DisplayPass)
#endif
