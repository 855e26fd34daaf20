// Pass normals: the normal of the water from its height, by central differences.
//
//   normal = normalize(-slope_x, -slope_y, 1) in axes of the glass: x along u, y in the glass across it, z outward
//
// as-published multiplies each tap by the wiper mask, so the edge of the mask adds a slope (-height grad mask); corrected scales the slope.
#ifndef RAINREF_FN
#ifndef RAINREF_WINDSHIELD_NORMALS_PASS_H_
#define RAINREF_WINDSHIELD_NORMALS_PASS_H_
#include "pass/definition.h"
#include "scene/uniform_block.h"

namespace rainref::windshield {

struct NormalsUniforms {
  float slope_x, slope_shear, slope_y, padding0;
};
static_assert(sizeof(NormalsUniforms) == 16);

struct NormalsPass : pass::Takes<NormalsUniforms> {
  static constexpr pass::About about{
      "normals", "The normal of the water in axes of the glass, z outward.", {1}, {1}, {"length", "normalize"}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::slope_x>("1/mm", {-1e9, 1e9}, "Slope along x for 1 mm across two columns."),
                  member<&U::slope_shear>("1/mm", {-1e9, 1e9}, "Slope along y for 1 mm across two columns; 0 as published."),
                  member<&U::slope_y>("1/mm", {-1e9, 1e9}, "Slope along y for 1 mm across two rows.")});
  }
  template <class B>
  struct Io {
    typename B::template Texels<Format::r16f, 1> height = pass::In{.name = "height", .from = "wipe_texture"};  // [mm]
    typename B::template Texels<Format::r16f, 1> mask = pass::In{.name = "mask", .from = "wipe_texture"};
    typename B::template Result<Format::rgba16f> normal =
        pass::Out{.name = "normal", .sentence = "Unit normal in axes of the glass, alpha 1.", .range = {-1, 1}, .alpha = "1"};
  };
};

}  // namespace rainref::windshield
#endif
#else

/// io has height and mask (dx, dy) around the texel.
template <class N, bool corrected, class Io>
RAINREF_FN Vec3<N> normal_of(const NormalsUniforms& u, const Io& io) {
  const auto tap = [&](int dx, int dy)
                       RAINREF_LAMBDA { return corrected ? io.height(dx, dy) : io.height(dx, dy) * (N(1.0f) - io.mask(dx, dy)); };
  const N across_columns = tap(1, 0) - tap(-1, 0), across_rows = tap(0, 1) - tap(0, -1);
  const N kept = corrected ? N(1.0f) - io.mask(0, 0) : N(1.0f);
  const N slope_x = kept * (N(u.slope_x) * across_columns);
  const N slope_y = kept * (N(u.slope_shear) * across_columns + N(u.slope_y) * across_rows);
  return normalize(Vec3<N>{-slope_x, -slope_y, N(1.0f)});
}
struct NormalsPassText {
  template <class N, bool corrected, class Io>
  static RAINREF_FN void run(const NormalsUniforms& u, const Io& io, int, int) {
    io.normal(normal_of<N, corrected>(u, io), N(1.0f));
  }
};
#endif
