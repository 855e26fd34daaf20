// cube_root-inl.h in lanes, in half the time of pow: the inverse cube root by Newton's method in float, a last step in double, and a
// correction for the difference of the float nearest 1/3 from 1/3. It is within 2^-51 of the power, and every float of the domain below
// then rounds as with pow: `cube_root_full` tests them all. Text only: include it in a kernel after lanes-inl.h and lane_pair-inl.h, before
// the pass texts that use it.

/// Inputs of the double step, for a vector.
struct CubeRootStart {
  Lanes x;
  Lanes inverse;   ///< x^(-1/3), to 2e-5
  Lanes exponent;  ///< x = 2^exponent m, m in [sqrt(1/2), sqrt(2))
  Lanes log;       ///< log m
};
RAINREF_FN CubeRootStart start_cube_root(Lanes x) {
  const Lanes::DI d;
  const Lanes one(1.0f);
  const auto bits = hn::BitCast(d, x.v);
  // The bits of a float, as an integer, are approximately its logarithm.
  const Lanes about(hn::BitCast(Lanes::D(), to_int(Lanes(hn::ConvertTo(Lanes::D(), bits)) * Lanes(-1.0f / 3.0f) + Lanes(0x1.52884p30f)).i));
  const Lanes e = one - (x * about) * (about * about);
  const Lanes inverse = about + (about * e) * (Lanes(1.0f / 3) + e * (Lanes(2.0f / 9) + e * Lanes(14.0f / 81)));
  const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(d, 0x3f3504f3)));
  const Lanes z = Lanes(hn::BitCast(Lanes::D(), hn::Sub(bits, hn::ShiftLeft<23>(exponent)))) - one;
  // log(1 + z) / z, z in [sqrt(1/2) - 1, sqrt(2) - 1], by Chebyshev interpolation, to 2e-7.
  Lanes p(-0x1.31335ap-4f);
  for (const float c : {0x1.064786p-3f, -0x1.0fb036p-3f, 0x1.22cf1p-3f, -0x1.5423bp-3f, 0x1.999e86p-3f, -0x1.000424p-2f, 0x1.55555ep-2f,
                        -0x1.fffff8p-2f, 0x1p+0f})
    p = p * z + Lanes(c);
  return {x, inverse, Lanes(hn::ConvertTo(Lanes::D(), exponent)), z * p};
}
/// R: doubles of one vector, or of two side by side. With d = 1 - x r^3 the cube root is x r^2 (1 - d)^(-2/3), and x^(1/3 + D) is that
/// times e^(D log x).
template <class R>
RAINREF_FN R finish_cube_root(const R& x, const R& inverse, const R& exponent, const R& log) {
  constexpr double excess = 0x1.5555555555555p-27;  // 1.0f / 3.0f - 1 / 3, which is 1 / 100663296
  const R close = (x * inverse) * inverse, d = 1.0 - close * inverse;
  const R root = close + close * (d * (2.0 / 3 + d * (5.0 / 9 + d * (40.0 / 81))));
  const R q = exponent * (0x1.62e42fefa39efp-1 * excess) + log * excess;
  return root + root * (q + q * (q * 0.5));
}
/// The float nearest to doubles in the range of float, without to_float's check for larger ones.
#if HWY_TARGET == HWY_SCALAR
RAINREF_FN Lanes nearest_float(const Real64Lanes& x) { return Lanes(hn::DemoteTo(NarrowTag(), x.v)); }
#else
RAINREF_FN Lanes nearest_float(const Real64Float& x) {
  return Lanes(hn::Combine(FloatTag(), hn::DemoteTo(NarrowTag(), x.upper.v), hn::DemoteTo(NarrowTag(), x.lower.v)));
}
#endif
/// True if all lanes are floats from 2^-24 to 2^28.
RAINREF_FN bool in_domain_of_cube_root(Lanes x) {
  const Lanes::DU d;
  return hn::AllTrue(d, hn::Lt(hn::Sub(hn::BitCast(d, x.v), hn::Set(d, 0x33800000u)), hn::Set(d, 0x4d800000u - 0x33800000u)));
}
RAINREF_FN Lanes cube_root(Lanes x) {
  if (HWY_UNLIKELY(!in_domain_of_cube_root(x))) return pow(x, Lanes(1.0f / 3.0f));
  const CubeRootStart s = start_cube_root(x);
  return nearest_float(
      finish_cube_root<Real64Float>(to_double(s.x.v), to_double(s.inverse.v), to_double(s.exponent.v), to_double(s.log.v)));
}
RAINREF_FN LanePair cube_root(const LanePair& x) {
  if (HWY_UNLIKELY(!in_domain_of_cube_root(x.a) || !in_domain_of_cube_root(x.b))) return pow(x, LanePair(1.0f / 3.0f));
  const CubeRootStart a = start_cube_root(x.a), b = start_cube_root(x.b);
  const Real64Two root = finish_cube_root<Real64Two>(to_double(LanePair(a.x, b.x)), to_double(LanePair(a.inverse, b.inverse)),
                                                     to_double(LanePair(a.exponent, b.exponent)), to_double(LanePair(a.log, b.log)));
  return LanePair(nearest_float(root.lower), nearest_float(root.upper));
}
