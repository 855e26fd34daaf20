// Pass display: linear radiance to display code values in [0, 1].
#ifndef RAINREF_FN
#ifndef RAINREF_PUDDLE_DISPLAY_PASS_H_
#define RAINREF_PUDDLE_DISPLAY_PASS_H_
#include "pass/definition.h"
#include "puddle/uniforms.h"
#include "scene/uniform_block.h"

namespace rainref::puddle {

struct DisplayPass : pass::Takes<DisplayUniforms> {
  static constexpr pass::About about{"display", "Vignette and display code.", {1}, {1}, {"length"}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::vignette>("1", {0, 1.5}, "Loss at distance 1 from the centre."),
                  member<&U::exposure>("1", scene::exposure_factor, "corrected: factor of the radiance."),
                  member<&U::width>("pixel", scene::whole(1, 65536), "Columns of the picture."),
                  member<&U::height>("pixel", scene::whole(1, 65536), "Rows of the picture.")});
  }
  template <class B>
  struct Io {
    static constexpr std::string_view meaning = "Display code, alpha 1. Row 0 is the bottom of the picture.";
    typename B::template Texels<Format::rgba16f> colour = pass::In{.name = "colour", .from = "shade"};
    typename B::template Result<Format::rgba8> picture = {
        pass::Out{.name = "picture",
                  .sentence = meaning,
                  .encoding = "code = power 0.4545 of the radiance",
                  .colour_space = "Rec. 709 primaries",
                  .alpha = "1"},
        pass::Out{.name = "picture", .sentence = meaning, .encoding = "sRGB (IEC 61966-2-1)", .colour_space = "sRGB", .alpha = "1"}};
  };
};

}  // namespace rainref::puddle
#endif
#else

template <class N>
RAINREF_FN N vignette(const DisplayUniforms& u, int px, int py) {
  const N x = (N::index(px) + N(0.5f)) / N(u.width) - N(0.5f), y = N(static_cast<float>(py) + 0.5f) / N(u.height) - N(0.5f);
  return N(1.0f) - N(u.vignette) * length(x, y);
}
/// As published: the power 0.4545. A vignette above sqrt(2) would make its base negative, so scenes refuse it.
template <class N>
RAINREF_FN Vec3<N> display_as_published(const DisplayUniforms& u, const Vec3<N>& colour, int px, int py) {
  const Vec3<N> c = vignette<N>(u, px, py) * colour;
  return pow(c, N(0.4545f));
}
/// Corrected: exposure, a vignette that ends at black, sRGB.
template <class N>
RAINREF_FN Vec3<N> exposed(const DisplayUniforms& u, const Vec3<N>& colour, int px, int py) {
  constexpr const char* is_lit = "a vignette of at most the root of 2 leaves some light in the corners";
  return (guard<N>(max(vignette<N>(u, px, py), N(0.0f)), is_lit) * N(u.exposure)) * colour;
}
template <class N>
RAINREF_FN Vec3<N> display_corrected(const DisplayUniforms& u, const Vec3<N>& colour, int px, int py) {
  return display_code(exposed(u, colour, px, py));
}
struct DisplayPassText {
  template <class N, bool corrected, class Io>
  static RAINREF_FN void run(const DisplayUniforms& u, const Io& io, int px, int py) {
    io.picture(corrected ? display_corrected<N>(u, io.colour.rgb(), px, py) : display_as_published<N>(u, io.colour.rgb(), px, py), N(1.0f));
  }
};
#endif
