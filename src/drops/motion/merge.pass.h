// Pass merge, corrected: which drops touch, the merger of two drops, and the trail of a sliding drop. Needs integrate.pass.h.
//
// The result for a drop depends on the drops that it touches, and for a texel of the film on the drops that slide over it. Other code finds
// them (merge.cpp; evaluations_merge.cpp for the judge), so the arithmetic here is for a pair, a drop and a texel.
#ifndef RAINREF_FN
#ifndef RAINREF_DROPS_MERGE_PASS_H_
#define RAINREF_DROPS_MERGE_PASS_H_
#include <fmt/format.h>

#include "drops/records.h"
#include "drops/uniforms.h"
#include "pass/definition.h"
#include "scene/uniform_block.h"

namespace rainref::drops {

struct MergePass : pass::Takes<MergeUniforms> {
  static constexpr pass::About about{"merge",    "Drops that touch become one; sliding drops leave trails on the film.",
                                     {},         {1, capture::Judge::keyed},
                                     {"length"}, "ordered_scatter"};
  static scene::UniformBlock uniforms() {
    return block({member<&U::frame>("m", {-1e4, 1e4}, "As in IntegrateUniforms."),
                  member<&U::radius>("m", scene::share, "Base radius over mass^(1/3)."),
                  member<&U::trail>("1/m^2", {0, 1e12}, "Mass units left over base radius and way."),
                  member<&U::dt>("s", {0, 1}, "The step."), member<&U::film>("texel", {1, 65536}, "Columns and rows of the film."),
                  member<&U::drying>("1", {0, most_mass}, "Mass units that each texel of the film loses in this step.")});
  }
  template <class Inputs>
  static std::string fault(const Inputs& m) {
    const MergeUniforms& u = m.uniforms;
    if (u.film[0] != m.width || u.film[1] != m.height || !(u.frame[0] > 0) || !(u.frame[2] > 0))
      return fmt::format("uniforms film and frame: expected {}x{} and positive scales, found {}x{} and {}, {}", m.width, m.height,
                         u.film[0], u.film[1], u.frame[0], u.frame[2]);
    for (const Drop& d : m.captured.drops.records)
      for (const float x : {d.position[0], d.position[1], d.velocity[0], d.velocity[1], d.mass, d.life})
        if (!(x - x == 0)) return fmt::format("in.drops: expected finite numbers, found {} (id {})", x, d.id);
    return "";
  }
  template <class B>
  struct Io {
    typename B::template Changed<Drop> drops = {pass::In{.name = "drops", .variant = "corrected"}, pass::Out{.name = "drops"}};
    typename B::template Texels<Format::r32f> film = pass::In{.name = "film", .variant = "corrected"};
    typename B::template Result<Format::r32f> new_film =
        pass::Out{.name = "film",
                  .sentence = "Water on the glass that is no drop: whole mass units of 2e-11 kg in a texel.",
                  .range = {0, most_mass}};
  };
};

}  // namespace rainref::drops
#endif
#else

/// Base radius [m].
template <class N>
RAINREF_FN N base_radius(const MergeUniforms& c, N mass) {
  return N(c.radius) * cube_root_of_mass(mass, 1.0f);
}
/// Plane coordinates [m] of a drop.
template <class N>
RAINREF_FN N plane_x(const MergeUniforms& c, N u, N v) {
  return N(c.frame[0]) * u + N(c.frame[1]) * v;
}
template <class N>
RAINREF_FN N plane_y(const MergeUniforms& c, N v) {
  return N(c.frame[2]) * v;
}

/// Whether two base circles overlap, given centres [m] and radii [m].
template <class N>
RAINREF_FN auto touches(N x1, N y1, N radius1, N x2, N y2, N radius2) {
  return square(x1 - x2) + square(y1 - y2) < square(radius1 + radius2);
}

/// Drop a after it takes b: mass and momentum are kept, the position is the centre of mass. id and life stay those of a. (physics: W8)
template <class N>
RAINREF_FN DropState<N> absorb(const DropState<N>& a, const DropState<N>& b) {
  DropState<N> out = a;
  out.mass = a.mass + b.mass;
  const N share = b.mass / guard<N>(max(out.mass, N(1.0f)), all_have_mass);
  out.u = mix(a.u, b.u, share);
  out.v = mix(a.v, b.v, share);
  out.velocity_u = mix(a.velocity_u, b.velocity_u, share);
  out.velocity_v = mix(a.velocity_v, b.velocity_v, share);
  return out;
}

/// The film after a step of drying, before trails are added.
template <class N>
RAINREF_FN N dried(const MergeUniforms& c, N film) {
  return max(film - N(c.drying), N(0.0f));
}

/// The trail of a sliding drop, and its position: under the tail, one base radius behind the centre.
template <class N>
struct Trail {
  N mass_units, u, v;  ///< mass_units is not yet whole as tail() returns it
  RAINREF_FN Trail() {}
};
/// Before rounding down to whole mass units.
template <class N>
RAINREF_FN Trail<N> tail(const MergeUniforms& c, const DropState<N>& d) {
  const N zero(0.0f), one(1.0f), radius = base_radius(c, d.mass);
  const N speed = length_on_glass(c.frame, d.velocity_u, d.velocity_v);
  const N back = radius / max(speed, N(1e-12f));  // time [s] since the centre was there
  Trail<N> out;
  out.u = d.u - d.velocity_u * back;
  out.v = d.v - d.velocity_v * back;
  const auto on_glass = (d.life > zero) & (out.u >= zero) & (out.u < one) & (out.v >= zero) & (out.v < one);
  out.mass_units = select(on_glass, (N(c.trail) * radius) * (speed * N(c.dt)), zero);
  return out;
}
/// A drop keeps at least one mass unit.
template <class N>
RAINREF_FN N whole_trail(N mass, N whole) {
  return guard<N>(max(min(mass - N(1.0f), whole), N(0.0f)), all_have_mass);
}
template <class N>
RAINREF_FN Trail<N> trail(const MergeUniforms& c, const DropState<N>& d) {
  Trail<N> out = tail(c, d);
  out.mass_units = whole_trail(d.mass, floor(out.mass_units));
  return out;
}
#endif
