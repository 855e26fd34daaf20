// A drop in the arithmetic of the passes. Text, for every number type; include it before the passes that need it.
#include "math/cube_root-inl.h"

/// The floats of the record Drop, in its order.
template <class N>
struct DropState {
  N u, v, velocity_u, velocity_v, mass, life;
  RAINREF_FN DropState() {}  // not implicit, because that would not be compiled for the SIMD target
  template <class Drop, class F>
  static RAINREF_FN void each(Drop& d, const F& f) {
    f(d.u);
    f(d.v);
    f(d.velocity_u);
    f(d.velocity_v);
    f(d.mass);
    f(d.life);
  }
  RAINREF_FN typename N::Mask lives() const { return life > N(0.0f); }
};
inline constexpr char all_live[] = "the list holds live drops alone", all_have_mass[] = "a live drop has a mass unit or more";
/// The cube root of a mass, at least that of `least`. With 1 it is exact for every live drop, whose mass is a whole number.
template <class N>
RAINREF_FN N cube_root_of_mass(N mass, float least) {
  return cube_root(guard<N>(max(mass, N(least)), all_have_mass));
}
