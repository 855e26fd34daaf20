// Pass background: the scene out of focus, without water.

template <class N, class T>
RAINREF_FN Vec3<N> scene_at(const T& scene, N u, N v, N level) {
  const auto s = sample_trilinear<0, 3, N>(scene, u, v, level);
  return Vec3<N>(s[0], s[1], s[2]);
}

/// textureLod(scene, pixel / resolution, level)
template <class N, class T>
RAINREF_FN Vec3<N> background_as_published(const BackgroundUniforms& b, const T& scene, int column, int row) {
  return scene_at<N>(scene, (N::index(column) + N(0.5f)) / N(b.resolution[0]), N(static_cast<float>(row) + 0.5f) / N(b.resolution[1]), N(b.level));
}

/// The mean over a disc: what a camera that focuses on the glass sees of a far point, spread evenly.
template <class N, class T>
RAINREF_FN Vec3<N> background_corrected(const BackgroundUniforms& b, const T& scene, const Tap* taps, int column, int row) {
  const N u = (N::index(column) + N(0.5f)) * N(b.scale[0]) + N(b.offset[0]), v = N(static_cast<float>(row) + 0.5f) * N(b.scale[1]) + N(b.offset[1]), zero(0.0f);
  Vec3<N> sum(zero, zero, zero);
  for (int k = 0; k < b.tap_count; ++k) sum = sum + scene_at<N>(scene, u + N(taps[k].x), v + N(taps[k].y), N(b.level));
  return N(b.weight) * sum;
}
