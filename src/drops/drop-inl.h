// A drop as the passes compute with it. Text, for every number; before the passes that need it.
#include "math/cube_root-inl.h"

/// The floats of the record Drop, in its order.
template <class N>
struct DropState {
  N u, v, velocity_u, velocity_v, mass, life;
  RAINREF_FN DropState() {}  // an implicit one would not be compiled for the SIMD target
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
/// The cube root of a mass that counts as `least` at least: 1 makes it that of a live drop, of which the mass is whole.
template <class N>
RAINREF_FN N cube_root_of_mass(N mass, float least) {
  return cube_root(max(mass, N(least)));
}
