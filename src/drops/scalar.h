// The scalar evaluations of integrate and merge: Scalar, Enclosure, Rearranged and Perturbed. A namespace of their own, so that argument
// types of this room do not pull them into the lanes.
#pragma once

#include "drops/records.h"
#include "drops/uniforms.h"
#include "math/perturbed.h"
#include "math/enclosure.h"
#include "math/scalar.h"
#include "math/rearranged.h"

namespace rainref::drops::scalar {
using namespace rainref::scalar;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "drops/integrate.pass.h"
#include "drops/merge.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::drops::scalar

namespace rainref::drops {

/// A stored drop as a number reads it.
template <class N>
scalar::DropState<N> state_of(const Drop& d) {
  scalar::DropState<N> s;
  s.u = N::load(&d.position[0]);
  s.v = N::load(&d.position[1]);
  s.velocity_u = N::load(&d.velocity[0]);
  s.velocity_v = N::load(&d.velocity[1]);
  s.mass = N::load(&d.mass);
  s.life = N::load(&d.life);
  return s;
}

}  // namespace rainref::drops
