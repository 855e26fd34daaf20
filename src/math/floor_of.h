// The floor of a double by the scalar number's rule, without a library.
#pragma once

#include "math/scalar.h"

namespace rainref {

inline double floor_of(double x) { return floor(scalar::Scalar<double>(x)).v; }

}  // namespace rainref
