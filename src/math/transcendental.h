// The transcendental functions over arrays, on the SIMD target in use: for tests, benchmarks and tables.
#pragma once

#include <cstddef>

namespace rainref {

/// out[i] = f(x[i]) for i in [0, count). Domain and accuracy stand at the formulas, in transcendental-inl.h. Arguments
/// are finite; out may be the same array as an argument. The bits do not depend on the target or on count.
void exp_array(const float* x, float* out, std::size_t count);
void exp2_array(const float* x, float* out, std::size_t count);
void log_array(const float* x, float* out, std::size_t count);
void sin_array(const float* x, float* out, std::size_t count);
void cos_array(const float* x, float* out, std::size_t count);

/// out[i] = f(a[i], b[i]).
void pow_array(const float* x, const float* y, float* out, std::size_t count);
void atan2_array(const float* y, const float* x, float* out, std::size_t count);

}  // namespace rainref
