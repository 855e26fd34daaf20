// display in lanes; compiled once for each SIMD target.
#include "pass/display.h"

#include "math/real64.h"
#include "pass/info.h"

#define RAINREF_KERNELS "pass/display.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"
#include "pass/rows-inl.h"

RAINREF_TARGET_BEGIN(pass)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "math/optics-inl.h"
#include "pass/display.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA
RAINREF_PASS_ROWS(DisplayPass)
RAINREF_PASS_ROWS(DisplayOfCodesPass)
RAINREF_TARGET_END(pass)

#if RAINREF_ONCE
RAINREF_PASS_DISPATCH(pass, DisplayPass)
RAINREF_PASS_DISPATCH(pass, DisplayOfCodesPass)

namespace rainref::pass {

DisplayUniforms display_uniforms(double exposure) {
  DisplayUniforms u{};
  u.exposure = static_cast<float>(exp2_real(Real64(exposure)).v);
  return u;
}
CodeTable display_table(int width, int height, double exposure, Rounding rounding) {
  return CodeTable(width, height, [exposure, rounding](const Image& colour, Image& picture, int y0, int y1) {
    display_run(exposure, rounding, colour, picture).tile(parallel::Tile{0, y0, colour.width(), y1});
  });
}

capture::PassInfo display_info(const std::string& from) {
  capture::PassInfo info = info_of<DisplayPass>();
  info.reads.front().from = from;
  return info;
}
capture::BufferInfo display_buffer() {
  return {.name = "picture",
          .format = "rgba8",
          .sentence = "Display code, alpha 1. Row 0 is the bottom of the picture.",
          .encoding = "sRGB (IEC 61966-2-1)",
          .colour_space = "sRGB",
          .alpha = "1"};
}

}  // namespace rainref::pass
#endif
