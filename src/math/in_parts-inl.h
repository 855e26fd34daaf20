// A function of the pass vocabulary that few passes need. Text only; include vocabulary-inl.h before it, and in_parts.h if enclosures
// evaluate the pass.

/// f(x, y). It has a name because an enclosure gets tighter results part by part if the function uses its arguments often.
template <class N, class F>
RAINREF_FN Vec3<N> in_parts(N x, N y, const F& f) {
  return f(x, y);
}
