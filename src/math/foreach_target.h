// Compiles the including file once for every SIMD target. Highway is named in this room only; others write
//
//   #define RAINREF_KERNELS "puddle/kernels.cpp"     // this very file
//   #include "math/foreach_target.h"
//   #include "math/lanes-inl.h"
//   RAINREF_TARGET_BEGIN(puddle)
//   ... #include the pass texts, write shells over Lanes ...
//   RAINREF_TARGET_END(puddle)
//   #if RAINREF_ONCE
//   namespace rainref::puddle {
//   RAINREF_EXPORT(StepRow);
//   void step_row(...) { RAINREF_DISPATCH(StepRow)(...); }
//   }
//   #endif
//
// No include guard: it is the guard.
#include "math/disabled_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE RAINREF_KERNELS
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"

#define RAINREF_ONCE HWY_ONCE
#define RAINREF_EXPORT(function) HWY_EXPORT(function)
#define RAINREF_DISPATCH(function) HWY_DYNAMIC_DISPATCH(function)
#undef RAINREF_TARGET_BEGIN
#undef RAINREF_TARGET_END
// The target comes last: GCC 14 forgets what a macro says after the pragma in it.
#define RAINREF_TARGET_BEGIN(room)                                                                                \
  namespace rainref::room::HWY_NAMESPACE {                                                                        \
  using namespace rainref::HWY_NAMESPACE; /* NOLINT: the room's kernels read the lane type of their own target */ \
  HWY_BEFORE_NAMESPACE();
#define RAINREF_TARGET_END(room) \
  }                              \
  HWY_AFTER_NAMESPACE();
