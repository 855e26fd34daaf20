// The functions under test, with the number of floats for which each is known not to be correctly rounded.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "math/lanes_kernels.h"
#include "math/mpfr_oracle.h"
#include "math/real64.h"

namespace rainref::test {

/// The second argument: none, a constant, any float, one of like size, or a multiple of 2^-20 in [-8, 8).
enum class Second { none, fixed, any, alike, moderate };

struct Case {
  const char* name;
  Function function;
  /// Results that are not correctly rounded over all 2^32 first arguments, counted by transcendental_full.
  std::uint64_t not_nearest;
  Second second = Second::none;
  float constant = 0;
};

inline constexpr Case cases[] = {
    {"exp", Function::exp, 0},
    {"exp2", Function::exp2, 2},
    {"log", Function::log, 5},
    {"sin", Function::sin, 2},
    {"cos", Function::cos, 4},
    {"pow_2.2", Function::pow, 1, Second::fixed, 2.2f},
    {"pow_1/2.2", Function::pow, 2, Second::fixed, 1 / 2.2f},
    {"pow_2.4", Function::pow, 0, Second::fixed, 2.4f},
    {"pow_1/2.4", Function::pow, 3, Second::fixed, 1 / 2.4f},
    {"pow", Function::pow, 1, Second::moderate},
    {"atan2", Function::atan2, 0, Second::any},
    {"atan2_alike", Function::atan2, 5, Second::alike},
};

inline bool has_two_arguments(Function f) { return f == Function::pow || f == Function::atan2; }

/// The float with these bits, or 1 in place of an infinity or a NaN.
inline float finite_from_bits(std::uint32_t bits) { return (bits & 0x7f800000u) == 0x7f800000u ? 1.0f : std::bit_cast<float>(bits); }

/// The second argument that goes with the first argument of these bits.
inline float second_argument(const Case& c, std::uint32_t bits) {
  std::uint32_t hash = bits;  // the finalizer of MurmurHash3: one to one, so all floats occur
  hash = (hash ^ (hash >> 16)) * 0x85ebca6bu;
  hash = (hash ^ (hash >> 13)) * 0xc2b2ae35u;
  hash ^= hash >> 16;
  switch (c.second) {
    case Second::any:
      return finite_from_bits(hash);
    case Second::alike: {  // sign and mantissa of the hash, an exponent at most 4 away, so that no angle is trivial
      const int exponent = static_cast<int>(bits >> 23 & 0xff) + static_cast<int>(hash >> 23 & 7) - 3;
      return std::bit_cast<float>((hash & 0x807fffffu) | static_cast<std::uint32_t>(std::clamp(exponent, 0, 254)) << 23);
    }
    case Second::moderate:
      return static_cast<float>(static_cast<int>(hash >> 8) - (1 << 23)) * 0x1p-20f;
    default:
      return c.constant;
  }
}

/// A function in plain C++ of floats, of doubles, and on the SIMD target in use.
struct Implementation {
  float (*plain)(float a, float b);
  double (*real)(double a, double b);
  Operation lanes;
};
/// In the order of Function.
inline constexpr Implementation implementations[] = {
    {[](float a, float) { return exp_float(a); }, [](double a, double) { return exp_real(Real64(a)).v; }, Operation::exp_of},
    {[](float a, float) { return exp2_float(a); }, [](double a, double) { return exp2_real(Real64(a)).v; }, Operation::exp2_of},
    {[](float a, float) { return log_float(a); }, [](double a, double) { return log_real(Real64(a)).v; }, Operation::log_of},
    {[](float a, float) { return sin_float(a); }, [](double a, double) { return sin_real(Real64(a)).v; }, Operation::sin_of},
    {[](float a, float) { return cos_float(a); }, [](double a, double) { return cos_real(Real64(a)).v; }, Operation::cos_of},
    {[](float a, float b) { return pow_float(a, b); }, [](double a, double b) { return pow_real(Real64(a), Real64(b)).v; },
     Operation::pow_any},
    {[](float a, float b) { return atan2_float(a, b); }, [](double a, double b) { return atan2_real(Real64(a), Real64(b)).v; },
     Operation::atan2_of},
};
inline const Implementation& implementation(Function f) { return implementations[static_cast<int>(f)]; }

/// A function of each pair on the SIMD target in use; a multiple of padded_count of them.
inline void run_lanes(Function f, std::span<const float> a, std::span<const float> b, float* out) {
  apply_by_lanes(implementation(f).lanes, a.data(), b.data(), a.data(), out, a.size());
}

}  // namespace rainref::test
