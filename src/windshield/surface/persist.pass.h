// Pass persist: a height texture that persists and decays, so that drops leave trails.
#ifndef RAINREF_FN
#ifndef RAINREF_WINDSHIELD_PERSIST_PASS_H_
#define RAINREF_WINDSHIELD_PERSIST_PASS_H_
#include "pass/definition.h"
#include "scene/uniform_block.h"

namespace rainref::windshield {

struct PersistUniforms {
  float keep, padding0, padding1, padding2;
};
static_assert(sizeof(PersistUniforms) == 16);

/// As published only, and only if the scene asks for it; corrected has a film instead.
struct PersistPass : pass::Takes<PersistUniforms> {
  static constexpr pass::About about{
      "persist", "The height texture of the frame before, decayed, wherever this frame's drops are not higher.", {1}, {}};
  static scene::UniformBlock uniforms() { return block({member<&U::keep>("1", scene::share, "Share of the height that a frame leaves.")}); }
  template <class B>
  struct Io {
    typename B::template Texels<Format::r16f> height = pass::In{.name = "height", .from = "splat"};  // [mm]
    typename B::template Texels<Format::r16f> previous_height =
        pass::In{.name = "previous_height", .from = "wipe_texture", .previous = true};
    typename B::template Result<Format::r16f> new_height = pass::Out{.name = "height"};
  };
};

}  // namespace rainref::windshield
#endif
#else

struct PersistPassText {
  template <class N, bool corrected, class Io>
  static RAINREF_FN void run(const PersistUniforms& u, const Io& io, int, int) {
    io.new_height(max(io.height(), io.previous_height() * N(u.keep)));
  }
};
#endif
