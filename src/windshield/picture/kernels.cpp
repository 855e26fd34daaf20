// composite, soften, mist, join_panes and interior in lanes; compiled once for each SIMD target.
#include "pass/run.h"
#include "windshield/picture/composite.pass.h"
#include "windshield/picture/interior.pass.h"
#include "windshield/picture/join_panes.pass.h"
#include "windshield/picture/mist.pass.h"
#include "windshield/picture/soften.pass.h"

#define RAINREF_KERNELS "windshield/picture/kernels.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"
#include "pass/rows-inl.h"

RAINREF_TARGET_BEGIN(windshield)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "math/optics-inl.h"
#include "image/sampling-inl.h"
#include "image/sampling_lanes-inl.h"
#include "windshield/picture/composite.pass.h"
#include "windshield/picture/interior.pass.h"
#include "windshield/picture/join_panes.pass.h"
#include "windshield/picture/mist.pass.h"
#include "windshield/picture/soften.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA
RAINREF_PASS_ROWS(CompositePass)
RAINREF_PASS_ROWS(SoftenPass)
RAINREF_PASS_ROWS(MistPass)
RAINREF_PASS_ROWS(JoinPanesPass)
RAINREF_PASS_ROWS(InteriorPass)
RAINREF_TARGET_END(windshield)

#if RAINREF_ONCE
RAINREF_PASS_DISPATCH(windshield, CompositePass)
RAINREF_PASS_DISPATCH(windshield, SoftenPass)
RAINREF_PASS_DISPATCH(windshield, MistPass)
RAINREF_PASS_DISPATCH(windshield, JoinPanesPass)
RAINREF_PASS_DISPATCH(windshield, InteriorPass)
#endif
