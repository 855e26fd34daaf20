// binary16 as the processor converts it (F16C), where there is such a processor: the judge of our integer rule.
#pragma once

#include <cstddef>
#include <cstdint>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "rainref/image.h"

namespace rainref::test {

#if defined(__x86_64__)
inline bool has_half_hardware() { return __builtin_cpu_supports("f16c") && __builtin_cpu_supports("avx"); }

/// codes[i] = x[i] converted by hardware; count is a multiple of 8.
__attribute__((target("avx,f16c"))) inline void to_half_by_hardware(const float* x, std::uint16_t* codes, std::size_t count,
                                                                    Rounding rounding) {
  for (std::size_t i = 0; i < count; i += 8) {
    const __m256 v = _mm256_loadu_ps(x + i);
    const __m128i h = rounding == Rounding::rne ? _mm256_cvtps_ph(v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC)
                                                : _mm256_cvtps_ph(v, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(codes + i), h);
  }
}
/// x[i] = codes[i] converted by hardware; count is a multiple of 8.
__attribute__((target("avx,f16c"))) inline void to_float_by_hardware(const std::uint16_t* codes, float* x, std::size_t count) {
  for (std::size_t i = 0; i < count; i += 8) {
    _mm256_storeu_ps(x + i, _mm256_cvtph_ps(_mm_loadu_si128(reinterpret_cast<const __m128i*>(codes + i))));
  }
}
#else
inline bool has_half_hardware() { return false; }
inline void to_half_by_hardware(const float*, std::uint16_t*, std::size_t, Rounding) {}
inline void to_float_by_hardware(const std::uint16_t*, float*, std::size_t) {}
#endif

inline bool is_half_nan(std::uint16_t code) { return (code & 0x7fff) > 0x7c00; }

/// Equal codes; of a NaN the hardware keeps the payload and the rule does not, so there only sign and quietness count.
inline bool same_half(std::uint16_t rule, std::uint16_t hardware) {
  if (!is_half_nan(rule)) return rule == hardware;
  return is_half_nan(hardware) && (rule & 0x8200) == (hardware & 0x8200);
}

}  // namespace rainref::test
