// A function of the pass vocabulary that few passes need. Text only; include vocabulary-inl.h before it.

/// Whether the angle of (x, y), as a share of a turn starting at -pi, is at most 1/2: y < 0, or y = 0 and x > 0, or an angle above 0 that
/// is rounded away in the sum with pi. Lanes check the signs first (half_turn_lanes-inl.h).
template <class N>
RAINREF_FN typename N::Mask is_at_most_half_turn(N y, N x) {
  const N pi(3.14159265f);
  return (atan2(y, x) + pi) / N(2.0f * 3.14159265f) <= N(0.5f);
}
