// Pass join_panes: adds the view through one more pane of the car, where the eye looks through it. Needs composite.pass.h.
#ifndef RAINREF_FN
#ifndef RAINREF_WINDSHIELD_JOIN_PANES_PASS_H_
#define RAINREF_WINDSHIELD_JOIN_PANES_PASS_H_
#include "windshield/picture/composite.pass.h"

namespace rainref::windshield {

/// It runs for each pane after the first. Its uniforms are those of that pane's composite.
struct JoinPanesPass {
  static constexpr pass::About about{
      "join_panes", "The picture so far, and on a further pane what composite made of it.", {1}, {1}, {"dot"}};
  using Uniforms = CompositeUniforms;
  static scene::UniformBlock uniforms() { return CompositePass::uniforms(); }
  template <class B>
  struct Io {
    typename B::template Texels<Format::rgba16f> pane_colour = pass::In{.name = "pane_colour", .from = "composite"};
    typename B::template Texels<Format::rgba16f> colour = pass::In{.name = "colour", .from = "composite"};
    typename B::template Result<Format::rgba16f> joined = pass::Out{.name = "colour"};
  };
};

}  // namespace rainref::windshield
#endif
#else

struct JoinPanesPassText {
  template <class N, bool corrected, class Io>
  static RAINREF_FN void run(const CompositeUniforms& u, const Io& io, int column, int row) {
    io.joined(mix(io.colour.rgb(), io.pane_colour.rgb(), glass_point<N>(u, column, row).on_glass), N(1.0f));
  }
};
#endif
