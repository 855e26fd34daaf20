// A view from a place ahead of where a picture was taken. The point seen along (x, y, 1) at depth d lies in the picture's
// camera at P = d (x, y, 1) + way, where the picture holds its depth D, which should be d + way.z. One step of
//   d + (D - way.z - d) d / (d + way.z)
// finds d exactly on level ground, where a plain fixed-point step diverges; others follow in a few.

template <class N>
struct SeenFrom {
  Vec3<N> colour;
  N depth;
};
template <class N, class Colours, class Depths>
RAINREF_FN SeenFrom<N> seen_from(const ReprojectUniforms& r, const Colours& colour, const Depths& depth, N x, N y, float way) {
  const N half(0.5f), su = uniform_quotient(0.5f, r.half_size[0], N()), sv = uniform_quotient(0.5f, r.half_size[1], N()), nearest(0.5f);
  const N wx = N(way * r.forward[0]), wy = N(way * r.forward[1]), wz = N(way * r.forward[2]);
  N u = half + x * su, v = half + y * sv, d = max(sample_nearest<0, 1, N>(depth, u, v)[0], nearest);
  for (int round = 0; round < 4; ++round) {
    if (round > 0) d = max(d + (sample_nearest<0, 1, N>(depth, u, v)[0] - wz - d) * (d / (d + max(wz, N(0.0f)))), nearest);
    const N deep = N(1.0f) / max(d + wz, nearest);
    u = half + ((d * x + wx) * deep) * su;
    v = half + ((d * y + wy) * deep) * sv;
  }
  const auto c = sample_bilinear<0, 3, N>(colour, u, v);
  return {Vec3<N>(c[0], c[1], c[2]), d};
}
/// The newer view over the older one.
template <class N, class Colours, class Depths>
RAINREF_FN SeenFrom<N> reprojected(const ReprojectUniforms& r, const Colours& newer, const Depths& newer_depth, const Colours& older, const Depths& older_depth, int column, int row) {
  const N x = (N::index(column) + N(0.5f)) * N(r.pixel[0]) - N(r.half_size[0]), y = (N(static_cast<float>(row) + 0.5f)) * N(r.pixel[1]) - N(r.half_size[1]);
  const SeenFrom<N> a = seen_from<N>(r, newer, newer_depth, x, y, r.newer_by);
  if (r.weight == 1.0f) return a;
  const SeenFrom<N> b = seen_from<N>(r, older, older_depth, x, y, r.older_by);
  return {mix(b.colour, a.colour, N(r.weight)), a.depth};
}
