// Pass integrate: the motion of one drop in a step. Needs drop-inl.h.
#ifndef RAINREF_FN
#ifndef RAINREF_DROPS_INTEGRATE_PASS_H_
#define RAINREF_DROPS_INTEGRATE_PASS_H_
#include "drops/records.h"
#include "drops/uniforms.h"
#include "pass/definition.h"
#include "scene/uniform_block.h"

namespace rainref::drops {

/// Treats each drop separately.
struct IntegratePass : pass::Takes<IntegrateUniforms> {
  static constexpr pass::About about{"integrate",
                                     "Forces, motion, evaporation and age of every drop.",
                                     {1, capture::Judge::keyed},
                                     {1, capture::Judge::keyed},
                                     {"the forces", "length"}};
  using Record = Drop;
  static scene::UniformBlock uniforms() {
    return block({member<&U::frame>("m", {-1e4, 1e4}, "corrected: x = frame.x u + frame.y v and y = frame.z v in the plane of the glass."),
                  member<&U::dt>("s", {0, 1}, "The step."),
                  member<&U::inertia_coupling>("1", {0, 100}, "as-published: share of the vehicle's acceleration."),
                  member<&U::wind_coupling>("1/s", {0, 100}, "as-published: acceleration by a unit of wind."),
                  member<&U::drag>("1/s", {0, 1e9}, "as-published: rate of slowing down; corrected: that times mass^(2/3)."),
                  member<&U::wind_push>("1/m", {0, 1e9}, "corrected: acceleration over wind speed squared, times mass^(1/3)."),
                  member<&U::hold>("m/s^2", {0, 1e9}, "corrected: acceleration that hysteresis holds, times mass^(2/3)."),
                  member<&U::evaporation>("1/s", {0, 1e9}, "corrected: mass units lost in a second over mass^(1/3)."),
                  member<&U::margin>("1", scene::share, "corrected: how far outside the glass a drop lives."),
                  member<&U::rest_speed>("m/s", scene::share, "corrected: a held drop below this speed rests."),
                  member<&U::phase_rate>("1", {0, 1e7}, "corrected: turns in 64 s of the phase that rounds losses.")});
  }
  template <class B>
  struct Io {
    typename B::template Changed<Drop> drops = {pass::In{.name = "drops", .from = "spawn"}, pass::Out{.name = "drops"}};
    typename B::template Records<GlassFrame> glass_frame = pass::In{.name = "glass_frame", .records = 1};
  };
};

}  // namespace rainref::drops
#endif
#else

// ---- as published --------------------------------------------------------------------------------------------------
//   a = gravity mass - acceleration inertia_coupling + wind wind_coupling - velocity drag           (seed 000)
// The source does not give the integrator. We choose semi-implicit Euler: velocity += a dt, then position += velocity dt.
template <class N>
RAINREF_FN N force_as_published(const IntegrateUniforms& c, float gravity, float acceleration, float wind, N velocity, N mass) {
  return sum_any_order(N(gravity) * mass, -N(acceleration) * N(c.inertia_coupling), N(wind) * N(c.wind_coupling), -velocity * N(c.drag));
}
template <class N>
RAINREF_FN DropState<N> integrate_as_published(const IntegrateUniforms& c, const GlassFrame& g, const DropState<N>& d) {
  const auto alive = d.life > N(0.0f);
  const N dt(c.dt);
  const N velocity_u = d.velocity_u + force_as_published(c, g.gravity[0], g.acceleration[0], g.wind[0], d.velocity_u, d.mass) * dt;
  const N velocity_v = d.velocity_v + force_as_published(c, g.gravity[1], g.acceleration[1], g.wind[1], d.velocity_v, d.mass) * dt;
  DropState<N> out = d;
  out.velocity_u = guard<N>(select(alive, velocity_u, d.velocity_u), all_live);
  out.velocity_v = guard<N>(select(alive, velocity_v, d.velocity_v), all_live);
  out.u = guard<N>(select(alive, d.u + velocity_u * dt, d.u), all_live);
  out.v = guard<N>(select(alive, d.v + velocity_v * dt, d.v), all_live);
  out.life = guard<N>(select(alive, d.life - dt, d.life), all_live);
  return out;
}

// ---- corrected -----------------------------------------------------------------------------------------------------
// All forces proportional to the mass are one specific force, so braking equals a slope. Forces that depend on the size use the cube root
// of the mass: a hold of contact-angle hysteresis (force ~ width), a push of the wind (~ area), a viscous drag k (~ width). The motion
// under them is integrated exactly, with v_inf = a / k:
//   v' = v_inf + (v - v_inf) e^-kt        = v e^-kt + a t f,       f = (1 - e^-kt) / kt
//   x' = x + v_inf t + (v - v_inf) t f    = x + (v f + a t g) t,   g = (1 - f) / kt
// The forms on the right have no cancellation, and k may be 0.
template <class N>
struct Integrated : DropState<N> {
  N evaporated, removed;  ///< [mass units]
  RAINREF_FN Integrated() {}
  /// Ended drops are already marked by a life of 0.
  auto lives() const { return !is_ended(this->life); }
};
/// The length [m] of a vector in glass coordinates.
template <class N>
RAINREF_FN N length_on_glass(const float* frame, N u, N v) {
  return length(N(frame[0]) * u + N(frame[1]) * v, N(frame[2]) * v);
}

/// e^-x, f(x) and g(x) for x >= 0. Below 1/8 by their series, to 1e-8.
template <class N>
struct Decay {
  N speed, mean, way;
  RAINREF_FN Decay() {}
};
template <class N>
RAINREF_FN Decay<N> decay_of(N x) {
  const N one(1.0f), eighth(0.125f), safe = max(x, eighth);
  const auto small = x < eighth;
  Decay<N> out;
  out.speed = exp(-x);
  const N g = N(1.0f / 2) - x * (N(1.0f / 6) - x * (N(1.0f / 24) - x * (N(1.0f / 120) - x * N(1.0f / 720))));
  out.mean = select(small, one - x * g, (one - out.speed) / safe);
  out.way = select(small, g, (one - out.mean) / safe);
  return out;
}

template <class N>
RAINREF_FN Integrated<N> integrate_corrected(const IntegrateUniforms& c, const GlassFrame& g, const DropState<N>& d) {
  const N zero(0.0f), one(1.0f), dt(c.dt);
  const auto alive = d.life > zero;
  const N mass_3 = cube_root_of_mass(d.mass, 1.0f), inverse = one / mass_3, inverse_sq = square(inverse);

  const N wind_u(g.wind[0]), wind_v(g.wind[1]);
  const N push = (N(c.wind_push) * length_on_glass(c.frame, wind_u, wind_v)) * inverse;
  const N a_u = sum_any_order(N(g.gravity[0]), N(g.spin[0]) * d.u + N(g.spin[1]) * d.v,
                              N(g.coriolis[0]) * d.velocity_u + N(g.coriolis[1]) * d.velocity_v, push * wind_u);
  const N a_v = sum_any_order(N(g.gravity[1]), N(g.spin[2]) * d.u + N(g.spin[3]) * d.v,
                              N(g.coriolis[2]) * d.velocity_u + N(g.coriolis[3]) * d.velocity_v, push * wind_v);

  const N pull = max(length_on_glass(c.frame, a_u, a_v), N(1e-6f));
  const N share = max(one - (N(c.hold) * inverse_sq) / pull, zero);  // share of the force that is left to move the drop
  const N push_u = (a_u * share) * dt, push_v = (a_v * share) * dt;
  const Decay<N> decay = decay_of(N(c.drag) * inverse_sq * dt);
  const N velocity_u = d.velocity_u * decay.speed + push_u * decay.mean, velocity_v = d.velocity_v * decay.speed + push_v * decay.mean;
  const N u = d.u + (d.velocity_u * decay.mean + push_u * decay.way) * dt, v = d.v + (d.velocity_v * decay.mean + push_v * decay.way) * dt;
  // A held drop would slow down forever, so it is stopped.
  const auto rests = (share <= zero) & (length_on_glass(c.frame, velocity_u, velocity_v) < N(c.rest_speed));

  // Whole mass units leave. A phase uniform in [0, 1) rounds the loss down or up, so the mean is right. A phase from the accumulated loss
  // would drift, because each lost mass unit changes the rate.
  const N life = d.life - dt;
  const N loss = N(c.evaporation) * mass_3 * dt, phase = fract(fract(d.life * N(1.0f / 64)) * N(c.phase_rate));
  const N mass = max(d.mass - floor(loss + phase), zero);
  const N low(-c.margin), high = one + N(c.margin);
  const auto stays = (life > zero) & (mass > zero) & (u >= low) & (u <= high) & (v >= low) & (v <= high);

  Integrated<N> out;
  out.u = guard<N>(select(alive, u, d.u), all_live);
  out.v = guard<N>(select(alive, v, d.v), all_live);
  out.velocity_u = select(alive, select(rests, zero, velocity_u), d.velocity_u);
  out.velocity_v = select(alive, select(rests, zero, velocity_v), d.velocity_v);
  out.mass = select(alive & stays, mass, select(alive, zero, d.mass));
  out.life = select(alive & stays, life, select(alive, zero, d.life));
  out.evaporated = guard<N>(select(alive, d.mass - mass, zero), all_live);
  out.removed = select(alive & !stays, mass, zero);
  return out;
}

struct IntegratePassText {
  template <class N>
  using State = DropState<N>;
  /// as-published a drop keeps its mass, the fifth of its floats.
  template <bool corrected>
  static constexpr bool gives(int number) {
    return corrected || number != 4;
  }
  template <class N, bool corrected, class Io>
  static RAINREF_FN auto run_record(const IntegrateUniforms& u, const Io& io, const DropState<N>& d) {
    if constexpr (corrected)
      return integrate_corrected<N>(u, *io.glass_frame.data(), d);
    else
      return integrate_as_published<N>(u, *io.glass_frame.data(), d);
  }
};
#endif
