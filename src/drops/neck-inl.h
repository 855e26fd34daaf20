// A neck in the arithmetic of the passes. Text, for every number type; include it after drop-inl.h and before the passes that need it.

/// The floats of the record Neck, in its order.
template <class N>
struct NeckState {
  N offset_x, offset_y, share, left;
  RAINREF_FN NeckState() {}
  template <class Neck, class F>
  static RAINREF_FN void each(Neck& n, const F& f) {
    f(n.offset_x);
    f(n.offset_y);
    f(n.share);
    f(n.left);
  }
};
template <class N>
RAINREF_FN NeckState<N> loaded_neck(const float* offset, const float& share, const float& left) {
  NeckState<N> n;
  n.offset_x = N::load(offset);
  n.offset_y = N::load(offset + 1);
  n.share = N::load(&share);
  n.left = N::load(&left);
  return n;
}
/// Radii of the two footprints relative to that of their drop. At left = 1 they are the original radii; both grow until the larger one is
/// the whole drop.
template <class N>
struct Footprints {
  N larger, smaller;
};
template <class N>
RAINREF_FN Footprints<N> footprints(N share, N left) {
  constexpr const char* is_smaller = "the share of the smaller of two drops is between 0 and a half";
  const N larger = cube_root(guard<N>(max(N(1.0f) - share, N(0.125f)), is_smaller));
  const N smaller = cube_root(guard<N>(max(share, N(0.0f)), is_smaller));
  const N swollen = mix(N(1.0f) / larger, N(1.0f), left);
  return {larger * swollen, smaller * swollen};
}
