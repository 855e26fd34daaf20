// Pass display: linear radiance to display code values in [0, 1].

template <class N>
RAINREF_FN N vignette(const DisplayUniforms& u, int px, int py) {
  const N x = (N::index(px) + N(0.5f)) / N(u.width) - N(0.5f), y = N(static_cast<float>(py) + 0.5f) / N(u.height) - N(0.5f);
  return N(1.0f) - N(u.vignette) * length(x, y);
}
/// As published: the power 0.4545. A vignette above sqrt(2) would make its base negative; the scene refuses it.
template <class N>
RAINREF_FN Vec3<N> display_as_published(const DisplayUniforms& u, const Vec3<N>& colour, int px, int py) {
  const Vec3<N> c = vignette<N>(u, px, py) * colour;
  return pow(c, N(0.4545f));
}
/// Corrected: exposure, a vignette that ends at black, sRGB.
template <class N>
RAINREF_FN Vec3<N> display_corrected(const DisplayUniforms& u, const Vec3<N>& colour, int px, int py) {
  return display_code((max(vignette<N>(u, px, py), N(0.0f)) * N(u.exposure)) * colour);
}
