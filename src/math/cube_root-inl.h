// A function of the pass vocabulary that few passes need. Text only; include vocabulary-inl.h before it.

/// x^y with y the float nearest 1/3, by pow. Lanes have a faster version (cube_root_lanes-inl.h).
template <class N>
RAINREF_FN N cube_root(N x) {
  return pow(x, N(1.0f / 3.0f));
}
