// Pass display of every effect but the puddle, whose picture has a vignette: linear radiance to sRGB codes. Needs optics-inl.h.
#ifndef RAINREF_FN
#ifndef RAINREF_PASS_DISPLAY_PASS_H_
#define RAINREF_PASS_DISPLAY_PASS_H_
#include "pass/definition.h"
#include "scene/uniform_block.h"

namespace rainref::pass {

struct DisplayUniforms {
  float exposure, padding0, padding1, padding2;
};
static_assert(sizeof(DisplayUniforms) == 16);

/// Of a colour in this format. Each effect declares its picture itself; display_info names the pass that the colour comes from.
template <Format of>
struct DisplayOf : pass::Takes<DisplayUniforms> {
  static constexpr About about{"display", "Display code.", {1}, {1}};
  static scene::UniformBlock uniforms() { return block({member<&U::exposure>("1", scene::exposure_factor, "Factor of the radiance.")}); }
  template <class B>
  struct Io {
    typename B::template Texels<of> colour = In{.name = "colour"};
    typename B::template Result<Format::rgba8> picture = Out{.name = "picture"};
  };
};
using DisplayPass = DisplayOf<Format::rgba16f>;
/// Of a target of 8 bits a channel: linear radiance, code / 255.
using DisplayOfCodesPass = DisplayOf<Format::rgba8>;

}  // namespace rainref::pass
#endif
#else

template <class N>
RAINREF_FN Vec3<N> display(const DisplayUniforms& u, const Vec3<N>& colour) {
  return display_code(N(u.exposure) * colour);
}
struct DisplayPassText {
  template <class N, bool, class Io>
  static RAINREF_FN void run(const DisplayUniforms& u, const Io& io, int, int) {
    io.picture(display<N>(u, io.colour.rgb()), N(1.0f));
  }
};
using DisplayOfCodesPassText = DisplayPassText;
#endif
