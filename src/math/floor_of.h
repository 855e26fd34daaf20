// The floor of a double by the scalar number's own rule: no library's.
#pragma once

#include "math/scalar.h"

namespace rainref {

inline double floor_of(double x) { return floor(scalar::Scalar<double>(x)).v; }

}  // namespace rainref
