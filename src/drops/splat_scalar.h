// The scalar evaluations of splat: Scalar, Enclosure and Perturbed. A namespace of their own, so that argument types of this
// room do not pull them into the lanes.
#pragma once

#include "drops/records.h"
#include "drops/splat_uniforms.h"
#include "math/perturbed.h"
#include "math/enclosure.h"
#include "math/scalar.h"
#include "math/rearranged.h"

namespace rainref::drops::scalar {
using namespace rainref::scalar;

/// The quotient grows with x, and the two x in it are one.
inline enclosed::Enclosure over_larger(enclosed::Enclosure x, float least) {
  const enclosed::Enclosure s(least);
  if (enclosed::profile().reference) return x / max(x, s);
  x = x.unrounded();
  const auto at = [&](float end) { return enclosed::Enclosure(end, end) / max(enclosed::Enclosure(end, end), s); };
  return hull(at(x.lo), at(x.hi));
}

#define RAINREF_FN inline
#include "drops/splat.pass.h"
#undef RAINREF_FN

}  // namespace rainref::drops::scalar
