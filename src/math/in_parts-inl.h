// A word of the pass vocabulary that few passes need. Text only; needs vocabulary-inl.h before it, and in_parts.h where enclosures
// read the pass.

/// f(x, y), named because an enclosure reads a function that uses its arguments often better part by part.
template <class N, class F>
RAINREF_FN Vec3<N> in_parts(N x, N y, const F& f) {
  return f(x, y);
}
