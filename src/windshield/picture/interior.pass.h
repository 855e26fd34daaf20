// Pass interior: the dark interior of the car, over the view through the glass.
#ifndef RAINREF_FN
#ifndef RAINREF_WINDSHIELD_INTERIOR_PASS_H_
#define RAINREF_WINDSHIELD_INTERIOR_PASS_H_
#include "pass/definition.h"
#include "scene/uniform_block.h"

namespace rainref::windshield {

struct InteriorUniforms {
  float light, padding0, padding1, padding2;
};
static_assert(sizeof(InteriorUniforms) == 16);

/// It runs after the passes of all panes if the scene asks for it. In place.
struct InteriorPass : pass::Takes<InteriorUniforms> {
  static constexpr pass::About about{"interior", "Pillar and dashboard before the glass, over what is seen through it.", {}, {1}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::light>("1", {0, 100}, "Radiance of what is 1 in the interior's picture.")});
  }
  template <class B>
  struct Io {
    typename B::template Texels<Format::rgba16f> interior = pass::In{.name = "interior", .variant = "corrected"};
    typename B::template Texels<Format::rgba16f> colour = pass::In{.name = "colour", .from = "composite", .variant = "corrected"};
    typename B::template Result<Format::rgba16f> seen = pass::Out{.name = "colour", .variant = "corrected"};
  };
};

}  // namespace rainref::windshield
#endif
#else

// Colours are premultiplied, so a reflection in the glass, which hides nothing, is light without coverage.
struct InteriorPassText {
  template <class N, bool corrected, class Io>
  static RAINREF_FN void run(const InteriorUniforms& u, const Io& io, int, int) {
    N inside[4];
    io.interior.load(inside);
    const N open = N(1.0f) - inside[3];
    const Vec3<N> behind = io.colour.rgb();
    io.seen(Vec3<N>{N(u.light) * inside[0] + open * behind.x, N(u.light) * inside[1] + open * behind.y,
                    N(u.light) * inside[2] + open * behind.z},
            N(1.0f));
  }
};
#endif
