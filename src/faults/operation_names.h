// Operations as a shader writes them.
#pragma once

#include "math/places.h"

namespace rainref::faults {

/// "min", "sqrt", ...; "" where it is written otherwise.
const char* function_of(perturbed::Op op);
/// " + ", " * ", ... with its spaces; "" where none stands between two operands.
const char* sign_of(perturbed::Op op);

}  // namespace rainref::faults
