// The transcendental functions, each formula once: double arithmetic, one rounding to float at the end.
//
// Text only: no guard, no includes, no namespace. real64.h and real64_lanes-inl.h include it inside their namespaces, with RAINREF_FN as
// the specifier of a function, and with R as one double or as SIMD lanes of double.
//
// R has + - * /, comparisons, select and integer operations on its bits. Nothing here is fused, estimated or taken from the C library, so
// every evaluation gives the same bits.
//
// Arguments are finite floats. Every result is finite, also outside the domain, so that a lane whose result is not selected does no harm;
// infinite results saturate.
//
// Rounded to float, every result is within 0.500001 ULP. The docstrings count the results that are not the nearest float, over all 2^32
// floats and against MPFR; `transcendental_full --function NAME` repeats the measurement.
//
// If the argument is a double (the oracle), it must be 0 or normal and below 2^128. Except for saturation the result has a relative error
// of about 2^-50; absolute for sin and cos, and 2^-46 for pow where
// |y log2 x| is near 100.

/// c[0] + c[1] x + c[2] x^2 + ... by Horner's rule.
template <std::size_t First = 0, class R, std::size_t Count>
RAINREF_FN R polynomial(R x, const double (&c)[Count]) {
  if constexpr (First + 1 == Count) {
    return R(c[First]);
  } else {
    return polynomial<First + 1>(x, c) * x + R(c[First]);
  }
}

/// x, limited to +-limit.
template <class R>
RAINREF_FN R limit_magnitude(R x, double limit) {
  const R not_above = select(x > R(limit), R(limit), x);
  return select(not_above < R(-limit), R(-limit), not_above);
}

/// x, limited to the largest float. Highway's scalar conversion saturates and the processors' conversions give infinity, so such a number
/// must not reach them.
template <class R>
RAINREF_FN R saturate_to_float(R x) {
  return limit_magnitude(x, largest_float);
}

/// e^x. Saturates: the largest float above 88.7, 0 below -104. Not nearest: none.
template <class R>
RAINREF_FN R exp_real(R x) {
  const R limited = limit_magnitude(x, 120.0);
  const R biased = limited * coefficients::log2_e + whole_bias, k = biased - whole_bias;
  const R r = (limited - k * coefficients::ln2_high) - k * coefficients::ln2_low;
  return scale_by_power_of_two(1.0 + (r + (r * r) * polynomial(r, coefficients::exp_tail)), biased);
}

/// 2^(k + f) for |f| <= 1/2 and the whole number k in biased, |k| <= 1000.
template <class R>
RAINREF_FN R exp2_split(R biased, R f) {
  return scale_by_power_of_two(1.0 + f * polynomial(f, coefficients::exp2_tail), biased);
}

/// 2^x. Exact for whole numbers. Saturates: the largest float from 128 on, 0 from -150 down. Not nearest: 2.
template <class R>
RAINREF_FN R exp2_real(R x) {
  const R limited = limit_magnitude(x, 200.0);
  const R biased = limited + whole_bias;
  return exp2_split(biased, limited - (biased - whole_bias));
}

/// Half of log(m) for m in [sqrt(1/2), sqrt(2)): the area tangent of (m - 1) / (m + 1).
template <class R>
RAINREF_FN R half_log(R m) {
  const R q = (m - 1.0) / (m + 1.0), s = q * q;
  return q + (q * s) * polynomial(s, coefficients::log_tail);
}

/// log x, the natural logarithm, for x > 0. log 1 is 0. For x <= 0 it is the most negative float. Not nearest: 5.
template <class R>
RAINREF_FN R log_real(R x) {
  const auto inside = x > R(0.0);
  const R positive = select(inside, x, R(1.0));
  const R k = binary_exponent(positive);
  const R m = scale_by_power_of_two(positive, whole_bias - k);
  const R value = k * coefficients::ln2_high + (2.0 * half_log(m) + k * coefficients::ln2_low);
  return select(inside, value, R(-largest_float));
}

/// x^y for x >= 0, with x^0 = 1 and x^1 = x; 0^y is 0 for y > 0 and saturates for y < 0. x < 0 is read as 0.
/// Not nearest: 1 for y = 2.2, 2 for 1/2.2, none for 2.4, 3 for 1/2.4, and 1 when every x has its own y in [-8, 8). If x^y lies exactly
/// between two floats, as many squares do, the result may be either.
///
/// x = 2^k m: y k is exact for floats, so only y log2(m), at most |y| / 2, adds an error to the exponent.
template <class R>
RAINREF_FN R pow_real(R x, R y) {
  const auto inside = x > R(0.0);
  const R positive = select(inside, x, R(1.0));
  const R k = binary_exponent(positive);
  const R m = scale_by_power_of_two(positive, whole_bias - k);
  const R whole_part = y * k, other_part = y * (coefficients::two_log2_e * half_log(m));
  const R biased = limit_magnitude(whole_part + other_part, 200.0) + whole_bias;
  // Beyond the limit the rest is not a fraction; it only has to stay small.
  const R f = limit_magnitude((whole_part - (biased - whole_bias)) + other_part, 1.0);
  const R at_zero = select(y > R(0.0), R(0.0), select(y < R(0.0), R(largest_float), R(1.0)));
  return select(inside, exp2_split(biased, f), at_zero);
}

/// An angle x >= 0 as quarter turns (a whole number, biased) and a rest in [-pi/4, pi/4], up to rounding.
template <class R>
RAINREF_FN void split_angle(R x, R& biased_turns, R& rest) {
  R turns = (x * coefficients::two_over_pi + whole_bias) - whole_bias;
  rest = ((x - turns * coefficients::half_pi_1) - turns * coefficients::half_pi_2) - turns * coefficients::half_pi_3;
  if (R::any(x > R(largest_small_angle))) reduce_large_angles(x, turns, rest);
  biased_turns = turns + whole_bias;
}

/// The sine of turns quarter turns and a rest.
template <class R>
RAINREF_FN R sin_of_split(R biased_turns, R r) {
  const R s = r * r;
  const R sine = r + (r * s) * polynomial(s, coefficients::sin_tail);
  const R cosine = (1.0 - 0.5 * s) + (s * s) * polynomial(s, coefficients::cos_tail);
  return flip_sign_in_half_turn(select(is_odd(biased_turns), cosine, sine), biased_turns);
}

/// sin x for every finite float. Odd: sin(-x) = -sin(x) in all bits, and sin(-0) = -0. Not nearest: 2.
template <class R>
RAINREF_FN R sin_real(R x) {
  R turns = x, rest = x;
  split_angle(abs(x), turns, rest);
  return flip_sign(sin_of_split(turns, rest), x);
}

/// cos x for every finite float. Even in all bits. Not nearest: 4.
template <class R>
RAINREF_FN R cos_real(R x) {
  R turns = x, rest = x;
  split_angle(abs(x), turns, rest);
  return sin_of_split(turns + 1.0, rest);
}

/// The angle of the point (x, y) in [-pi, pi]. The zeros count with their sign, as in IEEE 754: atan2(+-0, x) is +-0 for x > 0 and x = +0,
/// and +-pi for x < 0 and x = -0. Not nearest: none among 2^32 pairs of any floats, 5 among 2^32 pairs of similar size.
template <class R>
RAINREF_FN R atan2_real(R y, R x) {
  const R width = abs(x), height = abs(y);
  const auto steep = width < height;
  const R longer = select(steep, height, width), shorter = select(steep, width, height);
  const R divisor = select(longer > R(0.0), longer, R(1.0));
  // The angle to the nearest axis lies in [0, pi/4]; above pi/8 it is measured from the diagonal.
  const auto diagonal = shorter > divisor * coefficients::tan_eighth_pi;
  const R t = select(diagonal, shorter - divisor, shorter) / select(diagonal, shorter + divisor, divisor);
  const R s = t * t;
  const R octant = t + (t * s) * polynomial(s, coefficients::atan_tail);
  const R to_axis = select(diagonal, coefficients::quarter_pi + octant, octant);
  const R quadrant = select(steep, coefficients::half_pi - to_axis, to_axis);
  return flip_sign(select(has_sign_bit(x), coefficients::full_pi - quadrant, quadrant), y);
}
