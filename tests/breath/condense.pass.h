// Pass condense: breath that settles on a cold pane and dries.
#ifndef RAINREF_FN
#ifndef RAINREF_TESTS_CONDENSE_PASS_H_
#define RAINREF_TESTS_CONDENSE_PASS_H_
#include "pass/definition.h"
#include "scene/uniform_block.h"

namespace rainref::breath {

struct CondenseUniforms {
  float centre[2], reach, rate;
  float drying;
  std::int32_t padding0, padding1, padding2;
};
struct CondensePass : pass::Takes<CondenseUniforms> {
  static constexpr pass::About about{"condense", "Breath that settles on the pane and dries.", {1}, {2}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::centre>("texel", {-1e5, 1e5}, "Where the mouth is."),
                  member<&U::reach>("texel", {1, 1e5}, "How far the breath goes."),
                  member<&U::rate>("um", {0, 100}, "Water that settles at the centre in a frame."),
                  member<&U::drying>("1", scene::share, "corrected: share of the water that dries in a frame.")});
  }
  template <class B>
  struct Io {
    typename B::template Texels<Format::r32f> film = pass::In{.name = "film", .from = "condense", .previous = true};
    typename B::template Result<Format::r32f> grown =
        pass::Out{.name = "film", .sentence = "Water on the pane.", .unit = "um", .range = {0, 1000}};
  };
};

}  // namespace rainref::breath
#endif
#else

struct CondensePassText {
  template <class N, bool corrected, class Io>
  static RAINREF_FN void run(const CondenseUniforms& u, const Io& io, int column, int row) {
    const N x = (N::index(column) - N(u.centre[0])) / N(u.reach), y = N((static_cast<float>(row) - u.centre[1]) / u.reach);
    const N near = saturate(N(1.0f) - length(x, y));
    if constexpr (corrected)
      io.grown(io.film() * N(1.0f - u.drying) + N(u.rate) * near);
    else
      io.grown(io.film() + N(u.rate) * near);
  }
};
#endif
