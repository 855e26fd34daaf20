// Pass veil: the scene through the breath.
#ifndef RAINREF_FN
#ifndef RAINREF_TESTS_VEIL_PASS_H_
#define RAINREF_TESTS_VEIL_PASS_H_
#include "pass/definition.h"
#include "scene/uniform_block.h"

namespace rainref::breath {

struct VeilUniforms {
  float veil[3], opacity;
};
struct VeilPass : pass::Takes<VeilUniforms> {
  static constexpr pass::About about{"veil", "The scene through the breath.", {1}, {1}};
  static scene::UniformBlock uniforms() {
    return block(
        {member<&U::veil>("1", scene::share, "Colour of the veil."), member<&U::opacity>("1/um", {0, 10}, "Of a micrometre of water.")});
  }
  template <class B>
  struct Io {
    typename B::template Texels<Format::r32f> film = pass::In{.name = "film", .from = "condense"};
    typename B::template Texels<Format::rgba16f> scene = pass::In{.name = "scene"};
    typename B::template Result<Format::rgba8> picture = pass::Out{.name = "picture", .sentence = "Display code."};
  };
};

}  // namespace rainref::breath
#endif
#else

struct VeilPassText {
  template <class N, bool, class Io>
  static RAINREF_FN void run(const VeilUniforms& u, const Io& io, int, int) {
    const N share = saturate(N(u.opacity) * io.film());
    const Vec3<N> s = io.scene.rgb();
    io.picture(Vec3<N>(mix(s.x, N(u.veil[0]), share), mix(s.y, N(u.veil[1]), share), mix(s.z, N(u.veil[2]), share)), N(1.0f));
  }
};
#endif
