// binary16 conversion of arrays by the SIMD target in use: the conversion of the lanes, for tests and benchmarks.
#pragma once

#include <cstddef>

#include "rainref/storage.h"

namespace rainref {

/// half[i] = to_half(x[i], rounding); x finite.
void to_half_array(const float* x, Half* half, std::size_t count, Rounding rounding);
/// x[i] = to_float(half[i]); no NaN.
void to_float_array(const Half* half, float* x, std::size_t count);

}  // namespace rainref
