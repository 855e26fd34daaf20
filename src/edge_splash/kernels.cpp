// splash in lanes; compiled once for each SIMD target.
#include <concepts>
#include <cstdint>

#include "edge_splash/splash.pass.h"
#include "image/texture.h"
#include "pass/run.h"

#define RAINREF_KERNELS "edge_splash/kernels.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"
#include "pass/rows-inl.h"

RAINREF_TARGET_BEGIN(edge_splash)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "math/optics-inl.h"
#include "image/sampling-inl.h"
#include "image/sampling_lanes-inl.h"
#include "math/half_turn-inl.h"
#include "math/half_turn_lanes-inl.h"
#include "edge_splash/splash.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA
RAINREF_PASS_ROWS(PublishedSplashPass)
RAINREF_PASS_ROWS(SplashPass)
RAINREF_TARGET_END(edge_splash)

#if RAINREF_ONCE
RAINREF_PASS_DISPATCH(edge_splash, PublishedSplashPass)
RAINREF_PASS_DISPATCH(edge_splash, SplashPass)
#endif
