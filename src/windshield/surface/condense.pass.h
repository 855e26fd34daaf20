// Pass condense: the mist of condensed water on the glass, which grows after water or a blade has cleared it.
#ifndef RAINREF_FN
#ifndef RAINREF_WINDSHIELD_CONDENSE_PASS_H_
#define RAINREF_WINDSHIELD_CONDENSE_PASS_H_
#include "pass/definition.h"
#include "scene/uniform_block.h"

namespace rainref::windshield {

struct CondenseUniforms {
  float dt, inverse_tau, limit, wiped_limit;
  float most, inverse_water, padding0, padding1;
};
static_assert(sizeof(CondenseUniforms) == 32);

/// Runs if the scene asks for it. In place.
struct CondensePass : pass::Takes<CondenseUniforms> {
  static constexpr pass::About about{
      "condense", "The mist of condensed water on the glass, as it has grown since water or a blade last cleared it.", {}, {1}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::dt>("s", {0, 1}, "Time since the frame before, so rounded that sums are exact."),
                  member<&U::inverse_tau>("1/s", {0, 100}, "1 over the time constant of the mist."),
                  member<&U::limit>("s", {0, 1 << 15}, "The time since the glass was cleared grows to this and no further."),
                  member<&U::wiped_limit>("s", {0, 1 << 15}, "Time since a wipe of glass that was never wiped."),
                  member<&U::most>("1", scene::share, "What the mist grows to: share of the light that it scatters."),
                  member<&U::inverse_water>("1/mm", {0, 1e6}, "1 over the height of water that takes all of the mist up.")});
  }
  template <class B>
  struct Io {
    typename B::template Texels<Format::r16f> height = pass::In{.name = "height", .from = "wipe_texture", .variant = "corrected"};  // [mm]
    typename B::template Texels<Format::r32f> wiped = pass::In{.name = "wiped", .from = "wipe_texture", .variant = "corrected"};
    typename B::template Texels<Format::r32f> clear_time =
        pass::In{.name = "clear_time", .from = "condense", .previous = true, .variant = "corrected"};
    typename B::template Result<Format::r16f> condensation =
        pass::Out{.name = "condensation", .sentence = "Share of the light that the mist on the glass scatters.", .variant = "corrected"};
    typename B::template Result<Format::r32f> new_clear_time =
        pass::Out{.name = "clear_time",
                  .sentence = "Time since water or a blade cleared the glass, to about 32 time constants of the mist.",
                  .unit = "s",
                  .range = {0, 16384},
                  .variant = "corrected"};
  };
};

}  // namespace rainref::windshield
#endif
#else

// clear_time = min(min(clear_time + dt, limit) (1 - taken), time since a wipe),   condensation = most (1 - exp(-clear_time / tau))
// Water (drops, their trails and the film) takes up the mist under it, by a share that grows with its height. The stored value is the time,
// not the mist, because a half that grows by less than half its last place per frame would not change.
struct CondensePassText {
  template <class N, bool corrected, class Io>
  static RAINREF_FN void run(const CondenseUniforms& u, const Io& io, int, int) {
    const N taken = min(io.height() * N(u.inverse_water), N(1.0f));
    const N grown = min(io.clear_time() + N(u.dt), N(u.limit)) * (N(1.0f) - taken);
    const N wiped = io.wiped();
    const N since = min(grown, select(wiped < N(u.wiped_limit), wiped, N(u.limit)));
    io.condensation(N(u.most) * (N(1.0f) - exp(-(since * N(u.inverse_tau)))));
    io.new_clear_time(since);
  }
};
#endif
