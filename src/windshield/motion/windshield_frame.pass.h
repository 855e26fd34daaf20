// Pass windshield_frame: the forces on drops on the glass, in glass coordinates.
#ifndef RAINREF_FN
#ifndef RAINREF_WINDSHIELD_WINDSHIELD_FRAME_PASS_H_
#define RAINREF_WINDSHIELD_WINDSHIELD_FRAME_PASS_H_
#include "drops/records.h"
#include "pass/definition.h"
#include "scene/uniform_block.h"
#include "windshield/motion/uniforms.h"

namespace rainref::windshield {

/// One record, computed from uniforms alone.
struct WindshieldFramePass : pass::Takes<WindshieldFrameUniforms> {
  static constexpr pass::About about{"windshield_frame",
                                     "Gravity, apparent wind and inertia in glass coordinates.",
                                     {1, capture::Judge::keyed},
                                     {1, capture::Judge::keyed},
                                     {"dot"}};
  using Record = drops::GlassFrame;
  static scene::UniformBlock uniforms() {
    return block(
        {member<&U::heading>("1", scene::component, "Cosine and sine of the car's heading, positive to the left."),
         member<&U::yaw_rate>("rad/s", {-1e3, 1e3}, "Turn rate of the car, positive to the left."),
         member<&U::yaw_acceleration>("rad/s^2", {-1e6, 1e6}, "Derivative of yaw_rate."),
         member<&U::world_wind>("m/s", {-100, 100}, "Velocity of the wind, world axes."),
         member<&U::gravity>("m/s^2", {-100, 100}, "Acceleration of gravity."),
         member<&U::vehicle_velocity>("m/s", {-1e3, 1e3}, "Velocity of the car, world axes.").guarded("the road is level", 2),
         member<&U::acceleration>("m/s^2", {-1e6, 1e6}, "Acceleration of the car's origin, car axes.").guarded("the road is level", 2),
         member<&U::e_u>("m", {-1e3, 1e3}, "Edge of the glass along u, car axes."),
         member<&U::e_v>("m", {-1e3, 1e3}, "Edge of the glass along v, car axes."),
         member<&U::origin>("m", {-100, 100}, "corrected: corner (0, 0) of the glass, car axes."),
         member<&U::inverse_metric>("1/m^2", {-1e12, 1e12},
                                    "as-published: 1 / |e_u|^2, 0, 1 / |e_v|^2; corrected: uu, uv and vv of the metric's inverse.")});
  }
  template <class B>
  struct Io {
    typename B::template List<drops::GlassFrame> glass_frame = pass::Out{.name = "glass_frame"};
  };
};

}  // namespace rainref::windshield
#endif
#else

/// The floats of the record GlassFrame, in its order.
template <class N>
struct GlassForces {
  N gravity[2], wind[2], acceleration[2], spin[4], coriolis[4];
  RAINREF_FN GlassForces() {}  // not implicit, because that would not be compiled for the SIMD target
  template <class Forces, class F>
  static RAINREF_FN void each(Forces& all, const F& f) {
    for (auto& x : all.gravity) f(x);
    for (auto& x : all.wind) f(x);
    for (auto& x : all.acceleration) f(x);
    for (auto& x : all.spin) f(x);
    for (auto& x : all.coriolis) f(x);
  }
};
/// The wind relative to the car, in its axes: world wind - velocity of the car, rotated by the heading.
template <class N>
RAINREF_FN Vec3<N> apparent_wind(const WindshieldFrameUniforms& u) {
  const Vec3<N> w = Vec3<N>(u.world_wind) - Vec3<N>(u.vehicle_velocity);
  const N c(u.heading[0]), s(u.heading[1]);
  return Vec3<N>{c * w.x + s * w.y, c * w.y - s * w.x, w.z};
}

// ---- as published --------------------------------------------------------------------------------------------------
// Each axis separately, f . e / |e|^2: exact only if the axes are perpendicular. Rotation acts only through the acceleration of the car's
// origin. (physics: W1, W2, E0 3 and 4)
template <class N>
RAINREF_FN void project_as_published(const WindshieldFrameUniforms& u, const Vec3<N>& f, N (&out)[2]) {
  out[0] = dot(f, Vec3<N>(u.e_u)) * N(u.inverse_metric[0]);
  out[1] = dot(f, Vec3<N>(u.e_v)) * N(u.inverse_metric[2]);
}
template <class N>
RAINREF_FN GlassForces<N> windshield_frame_as_published(const WindshieldFrameUniforms& u) {
  const N zero(0.0f);
  GlassForces<N> out;
  project_as_published(u, Vec3<N>{zero, zero, N(-u.gravity)}, out.gravity);
  project_as_published(u, apparent_wind<N>(u), out.wind);
  project_as_published(u, Vec3<N>(u.acceleration), out.acceleration);
  for (int k = 0; k < 4; ++k) out.spin[k] = out.coriolis[k] = zero;
  return out;
}

// ---- corrected -----------------------------------------------------------------------------------------------------
// G^-1 J^T f, exact on any flat glass. With w = (0, 0, yaw rate) and alpha its derivative the specific force at p is
//   g - a - alpha x p - w x (w x p),   and -2 w x v for a drop that moves with v.
// p = p0 + u e_u + v e_v, so the force is affine in u and v: its value at p0 is added to gravity, the rest to spin.
// (physics: W1-W3)
template <class N>
RAINREF_FN void project_corrected(const WindshieldFrameUniforms& u, const Vec3<N>& f, N& out_u, N& out_v) {
  const N along_u = dot(f, Vec3<N>(u.e_u)), along_v = dot(f, Vec3<N>(u.e_v));
  out_u = N(u.inverse_metric[0]) * along_u + N(u.inverse_metric[1]) * along_v;
  out_v = N(u.inverse_metric[1]) * along_u + N(u.inverse_metric[2]) * along_v;
}
/// -alpha x p - w x (w x p)
template <class N>
RAINREF_FN Vec3<N> spin_force(const WindshieldFrameUniforms& u, const Vec3<N>& p) {
  const N rate_sq = square(N(u.yaw_rate)), alpha(u.yaw_acceleration);
  return Vec3<N>{alpha * p.y + rate_sq * p.x, rate_sq * p.y - alpha * p.x, N(0.0f)};
}
/// -2 w x v
template <class N>
RAINREF_FN Vec3<N> coriolis_force(const WindshieldFrameUniforms& u, const Vec3<N>& v) {
  const N twice = N(2.0f) * N(u.yaw_rate);
  return Vec3<N>{twice * v.y, -(twice * v.x), N(0.0f)};
}
template <class N>
RAINREF_FN GlassForces<N> windshield_frame_corrected(const WindshieldFrameUniforms& u) {
  const Vec3<N> e_u(u.e_u), e_v(u.e_v), a(u.acceleration);
  const N zero(0.0f);
  GlassForces<N> out;
  const Vec3<N> still{-a.x, -a.y, -(N(u.gravity) + a.z)};
  project_corrected(u, still + spin_force(u, Vec3<N>(u.origin)), out.gravity[0], out.gravity[1]);
  project_corrected(u, apparent_wind<N>(u), out.wind[0], out.wind[1]);
  out.acceleration[0] = out.acceleration[1] = zero;
  project_corrected(u, spin_force(u, e_u), out.spin[0], out.spin[2]);
  project_corrected(u, spin_force(u, e_v), out.spin[1], out.spin[3]);
  project_corrected(u, coriolis_force(u, e_u), out.coriolis[0], out.coriolis[2]);
  project_corrected(u, coriolis_force(u, e_v), out.coriolis[1], out.coriolis[3]);
  return out;
}

struct WindshieldFramePassText {
  template <class N>
  using State = GlassForces<N>;
  template <class N, bool corrected, class Io>
  static RAINREF_FN GlassForces<N> run_record(const WindshieldFrameUniforms& u, const Io&) {
    if constexpr (corrected)
      return windshield_frame_corrected<N>(u);
    else
      return windshield_frame_as_published<N>(u);
  }
};
#endif
