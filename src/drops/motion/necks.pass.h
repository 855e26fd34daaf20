// Pass necks, corrected: the outlines of merged drops, which persist for a while. It runs before merge and follows its rule: of the drops
// that merge into one, the largest touches it and gives it its neck. Needs merge.pass.h and
// neck-inl.h.
//
// On glass with contact-angle hysteresis the contact line recedes only where the angle is below the receding angle. So two drops that meet
// keep their outlines, with a neck between them. Measurements show that such a drop becomes round exponentially, far more slowly than water
// flows (Andrieu, Beysens, Nikolayev and Pomeau 2002, J. Fluid Mech. 453, 427):
//   left = left e^(-dt / neck_time) - |velocity| dt / r
// A sliding drop carries its contact line with it, so the neck is gone when the drop has slid by its base radius r.
//
// As for merge, other code finds the touching drops (necks.cpp; evaluations_necks.cpp for the judge).
#ifndef RAINREF_FN
#ifndef RAINREF_DROPS_NECKS_PASS_H_
#define RAINREF_DROPS_NECKS_PASS_H_
#include <string>

#include <fmt/format.h>

#include "drops/records.h"
#include "drops/uniforms.h"
#include "pass/definition.h"
#include "scene/uniform_block.h"

namespace rainref::drops {

/// Returns why these records are not valid necks, or "".
template <class Records>
std::string necks_fault(const Records& necks) {
  for (const Neck& n : necks)
    if (!(n.offset[0] * n.offset[0] + n.offset[1] * n.offset[1] <= 4) || !(n.share >= 0 && n.share <= 0.5f) ||
        !(n.left >= 0 && n.left <= 1))
      return fmt::format(
          "in.necks: expected an offset of at most 2, a share of 0 to 0.5 and 0 to 1 that is left, found ({}, {}), {} and {} (id {})",
          n.offset[0], n.offset[1], n.share, n.left, n.id);
  return "";
}

struct NecksPass : pass::Takes<NecksUniforms> {
  static constexpr pass::About about{"necks",    "Outlines of drops that become one stay, with a neck, and recede.",
                                     {},         {1, capture::Judge::keyed},
                                     {"length"}, "ordered_scatter"};
  static scene::UniformBlock uniforms() {
    return block({member<&U::frame>("m", {-1e4, 1e4}, "As in IntegrateUniforms."),
                  member<&U::radius>("m", scene::share, "Base radius over mass^(1/3)."), member<&U::dt>("s", {0, 1}, "The step."),
                  member<&U::keep>("1", scene::share, "What a step leaves of a neck.")});
  }
  template <class Inputs>
  static std::string fault(const Inputs& m) {
    const NecksUniforms& u = m.uniforms;
    if (!(u.frame[0] > 0) || !(u.frame[2] > 0) || !(u.radius > 0))
      return fmt::format("uniforms frame and radius: expected positive scales, found {}, {} and {}", u.frame[0], u.frame[2], u.radius);
    for (const Drop& d : m.captured.drops.records)
      for (const float x : {d.position[0], d.position[1], d.velocity[0], d.velocity[1], d.mass, d.life})
        if (!(x - x == 0)) return fmt::format("in.drops: expected finite numbers, found {} (id {})", x, d.id);
    return necks_fault(m.captured.necks.records);
  }
  template <class B>
  struct Io {
    typename B::template Records<Drop> drops = pass::In{.name = "drops", .variant = "corrected"};
    typename B::template Changed<Neck> necks = {
        pass::In{.name = "necks", .from = "necks", .previous = true},
        pass::Out{.name = "necks", .sentence = "Outlines of merged drops, in ascending id.", .range = {-2, 2}, .record = "Neck"}};
  };
};

}  // namespace rainref::drops
#endif
#else

/// Base radius [m].
template <class N>
RAINREF_FN N neck_radius(const NecksUniforms& c, N mass) {
  return N(c.radius) * cube_root_of_mass(mass, 1.0f);
}
/// Whether two drops touch, as in merge.
template <class N>
RAINREF_FN auto overlap(const NecksUniforms& c, const DropState<N>& a, const DropState<N>& b) {
  const N x1 = N(c.frame[0]) * a.u + N(c.frame[1]) * a.v, x2 = N(c.frame[0]) * b.u + N(c.frame[1]) * b.v;
  return touches(x1, N(c.frame[2]) * a.v, neck_radius(c, a.mass), x2, N(c.frame[2]) * b.v, neck_radius(c, b.mass));
}
/// The neck of a drop a that takes b.
template <class N>
RAINREF_FN NeckState<N> joined(const NecksUniforms& c, const DropState<N>& a, const DropState<N>& b) {
  const N mass = a.mass + b.mass, inverse = N(1.0f) / neck_radius(c, mass), u = b.u - a.u, v = b.v - a.v;
  NeckState<N> out;
  out.offset_x = (N(c.frame[0]) * u + N(c.frame[1]) * v) * inverse;
  out.offset_y = (N(c.frame[2]) * v) * inverse;
  out.share = b.mass / guard<N>(max(mass, N(1.0f)), all_have_mass);
  out.left = N(1.0f);
  return out;
}
/// The neck after a step of the drop d.
template <class N>
RAINREF_FN NeckState<N> receded(const NecksUniforms& c, const NeckState<N>& n, const DropState<N>& d) {
  NeckState<N> out = n;
  const N way = length_on_glass(c.frame, d.velocity_u, d.velocity_v) * N(c.dt);
  out.left = max(n.left * N(c.keep) - way / neck_radius(c, d.mass), N(0.0f));
  return out;
}
/// Whether the smaller footprint is visible beside the larger one. The last 64th of a neck is dropped.
template <class N>
RAINREF_FN auto stands_out(const NeckState<N>& n) {
  const Footprints<N> r = footprints(n.share, n.left);
  return (n.left > N(1.0f / 64)) & (length(n.offset_x, n.offset_y) * n.left + r.smaller > r.larger);
}
/// For a drop that already has a neck and gets another: a larger lobe is not replaced by a smaller one.
template <class N>
RAINREF_FN NeckState<N> more_seen(const NeckState<N>& old, const NeckState<N>& fresh) {
  const auto stays = !stands_out(fresh) | (old.share * old.left > fresh.share);
  NeckState<N> out;
  out.offset_x = select(stays, old.offset_x, fresh.offset_x);
  out.offset_y = select(stays, old.offset_y, fresh.offset_y);
  out.share = select(stays, old.share, fresh.share);
  out.left = select(stays, old.left, fresh.left);
  return out;
}
#endif
