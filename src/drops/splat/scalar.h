// The text of splat for every number type except lanes.
#pragma once

#include "drops/motion/scalar.h"
#include "drops/splat/half_sum.h"
#include "drops/splat/splat.pass.h"

namespace rainref::drops::scalar {

/// Tighter than interval division: the quotient grows with x, and both x are the same number.
inline enclosed::Enclosure over_larger(enclosed::Enclosure x, float least) {
  const enclosed::Enclosure s(least);
  if (enclosed::profile().reference) return x / max(x, s);
  x = x.unrounded();
  const auto at = [&](float end) { return enclosed::Enclosure(end, end) / max(enclosed::Enclosure(end, end), s); };
  return hull(at(x.lo), at(x.hi));
}

#define RAINREF_FN inline
#include "drops/splat/splat.pass.h"
#undef RAINREF_FN

}  // namespace rainref::drops::scalar
