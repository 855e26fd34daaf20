// Correctly rounded transcendental functions by MPFR: what transcendental_test and transcendental_full measure against.
#pragma once

#include <mpfr.h>

#include <algorithm>
#include <cmath>

namespace rainref::test {

enum class Function { exp, exp2, log, sin, cos, pow, atan2 };

/// The functions as the documentation of transcendental-inl.h defines them: what is infinite or beyond the floats is
/// the largest float, log(x <= 0) its negative, pow(x < 0, y) is pow(0, y). One object for each thread.
class MpfrOracle {
 public:
  MpfrOracle() {
    // Enough that an exact tie, such as x^2 or x^3, is seen as one, and that no other result is mistaken for it.
    for (mpfr_ptr number : {x_, y_, value_, difference_}) mpfr_init2(number, 160);
  }
  ~MpfrOracle() {
    for (mpfr_ptr number : {x_, y_, value_, difference_}) mpfr_clear(number);
  }
  MpfrOracle(const MpfrOracle&) = delete;
  MpfrOracle& operator=(const MpfrOracle&) = delete;

  /// The float nearest to f(x) or f(x, y); atan2 is f(y, x), in this order.
  float nearest(Function f, float a, float b = 0.0f) {
    evaluate(f, a, b);
    return saturated(mpfr_get_flt(value_, MPFR_RNDN));
  }

  /// The same, from the C library's double where that settles it: its error is below 2^-51.
  float nearest_quickly(Function f, float a, float b = 0.0f) {
    const double value = in_double(f, a, b);
    const float low = saturated(static_cast<float>(value * (1 - 0x1p-51)));
    const float high = saturated(static_cast<float>(value * (1 + 0x1p-51)));
    return low == high ? low : nearest(f, a, b);
  }

  /// |got - f| in units of the last place of the nearest float.
  double error_in_ulp(Function f, float a, float b, float got) {
    const float reference = nearest(f, a, b);
    const int exponent = reference == 0.0f ? -149 : std::max(std::ilogb(reference) - 23, -149);
    if (std::fabs(reference) == 0x1.fffffep127f && got == reference) return 0.0;
    mpfr_sub_d(difference_, value_, got, MPFR_RNDN);
    mpfr_mul_2si(difference_, difference_, -exponent, MPFR_RNDN);
    return std::fabs(mpfr_get_d(difference_, MPFR_RNDN));
  }

  static double in_double(Function f, double a, double b) {
    switch (f) {
      case Function::exp:
        return std::exp(a);
      case Function::exp2:
        return std::exp2(a);
      case Function::log:
        return a > 0 ? std::log(a) : -HUGE_VAL;
      case Function::sin:
        return std::sin(a);
      case Function::cos:
        return std::cos(a);
      case Function::pow:
        return std::pow(a > 0 ? a : 0.0, b);
      case Function::atan2:
        return std::atan2(a, b);
    }
    return 0;
  }

 private:
  void evaluate(Function f, float a, float b) {
    const bool positive_only = f == Function::log || f == Function::pow;
    mpfr_set_flt(x_, positive_only && !(a > 0) ? 0.0f : a, MPFR_RNDN);
    mpfr_set_flt(y_, b, MPFR_RNDN);
    if (f == Function::pow)
      mpfr_pow(value_, x_, y_, MPFR_RNDN);
    else if (f == Function::atan2)
      mpfr_atan2(value_, x_, y_, MPFR_RNDN);
    else
      of_one_argument[static_cast<int>(f)](value_, x_, MPFR_RNDN);
  }
  /// In the order of Function.
  static constexpr int (*of_one_argument[])(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t) = {mpfr_exp, mpfr_exp2, mpfr_log, mpfr_sin, mpfr_cos};

  static float saturated(float x) { return std::clamp(x, -0x1.fffffep127f, 0x1.fffffep127f); }

  mpfr_t x_, y_, value_, difference_;
};

}  // namespace rainref::test
