// A drop, and the texts of integrate, merge and necks, with every number but lanes: Scalar, Enclosure, Rearranged and Perturbed. A
// namespace of their own, so that argument types of this room do not pull them into the lanes.
#pragma once

#include "drops/motion/integrate.pass.h"
#include "drops/motion/merge.pass.h"
#include "drops/motion/necks.pass.h"
#include "drops/records.h"
#include "math/numbers.h"
#include "pass/stored_record.h"

namespace rainref::drops::scalar {
using namespace rainref::scalar;

/// Whether a pass has set this life to 0; to compare it would be a decision more.
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

/// A stored drop as a number reads it.
template <class N>
scalar::DropState<N> state_of(const Drop& d) {
  return pass::loaded<scalar::DropState<N>>(d);
}

}  // namespace rainref::drops
