// A drop, and the texts of integrate, merge and necks, for every number type except lanes: Scalar, Enclosure, Rearranged and Perturbed.
// They have their own namespace, so that argument types of this room do not pull them into the lanes.
#pragma once

#include "drops/motion/integrate.pass.h"
#include "drops/motion/merge.pass.h"
#include "drops/motion/necks.pass.h"
#include "drops/records.h"
#include "math/numbers.h"
#include "pass/stored_record.h"

namespace rainref::drops::scalar {
using namespace rainref::scalar;

/// Whether a pass has set this life to 0. A comparison would be another decision.
template <class N>
bool is_ended(N life) {
  return life.v == 0;
}
inline bool is_ended(enclosed::Enclosure life) { return life.lo == 0 && life.hi == 0; }
inline bool is_ended(const enclosed::Rearranged& life) { return is_ended(life.settled()); }

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "drops/drop-inl.h"
#include "drops/neck-inl.h"
#include "drops/motion/integrate.pass.h"
#include "drops/motion/merge.pass.h"
#include "drops/motion/necks.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::drops::scalar

namespace rainref::drops {

/// Converts a stored drop to a number type.
template <class N>
scalar::DropState<N> state_of(const Drop& d) {
  return pass::loaded<scalar::DropState<N>>(d);
}

}  // namespace rainref::drops
