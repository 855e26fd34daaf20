// half_turn-inl.h in lanes, from the signs, which determine the result except for an angle below 2^-23. The masks are the same. Text only:
// include it in a kernel right after half_turn-inl.h.

RAINREF_FN Lanes::Mask is_at_most_half_turn(Lanes y, Lanes x) {
  const Lanes::D d;
  const Lanes::DI integers;
  const auto zero = hn::Zero(integers), y_bits = hn::BitCast(integers, y.v), x_bits = hn::BitCast(integers, x.v);
  // The float pi is odd in its last bit. So the sum is pi for an angle below 2^-23, which is half a unit of it, and larger from there on;
  // the next float divided by two pi is above 1/2. From y = 2^-22 x on the angle is above 2^-23, even if a subnormal product is a third too
  // small.
  const Lanes::Mask above{hn::RebindMask(d, hn::Gt(y_bits, zero))};
  if (any(above & (y < x * Lanes(0x1p-22f)))) return is_at_most_half_turn<Lanes>(y, x);
  // For y below 0, including -0, the angle is at most 0. At +0 it is 0 or, for x below 0 or -0, pi.
  const auto below = hn::Lt(y_bits, zero), on_axis = hn::AndNot(hn::Lt(x_bits, zero), hn::Eq(y_bits, zero));
  return {hn::RebindMask(d, hn::Or(below, on_axis))};
}
