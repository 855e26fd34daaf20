// A view from a place between two pictures, one taken behind it and one ahead. The point seen along (x, y, 1) at depth d lies in
// a picture's camera at P = d (x, y, 1) + way, where the picture holds its depth D, which should be d + way.z. One step of
//   d + (D - way.z - d) d / max(d, d + way.z)
// finds d exactly on level ground, where a plain fixed-point step diverges; others follow in a few. Where D does not come out
// as it should, something hid the point from that picture, and the other one counts.

template <class N>
struct SeenFrom {
  Vec3<N> colour;
  N depth;
  N fits;  ///< in [0, 1]: whether the picture shows the point
};
template <class N, class Colours, class Depths>
RAINREF_FN SeenFrom<N> seen_from(const ReprojectUniforms& r, const Colours& colour, const Depths& depth, N x, N y, float way, N guess, int rounds) {
  const N half(0.5f), one(1.0f), su = uniform_quotient(0.5f, r.half_size[0], N()), sv = uniform_quotient(0.5f, r.half_size[1], N()), nearest(0.5f);
  const N wx = N(way * r.forward[0]), wy = N(way * r.forward[1]), wz = N(way * r.forward[2]);
  N u, v, there, d = max(guess, nearest);
  for (int round = 0; round < rounds; ++round) {
    const N deep = one / max(d + wz, nearest);
    u = half + ((d * x + wx) * deep) * su;
    v = half + ((d * y + wy) * deep) * sv;
    there = sample_nearest<0, 1, N>(depth, u, v)[0];
    if (round + 1 < rounds) d = max(d + (way > 0 ? (d * deep) * (there - wz - d) : there - wz - d), nearest);
  }
  const N off = abs(there - wz - d) / d, border = min(min(u, one - u), min(v, one - v));
  const auto c = sample_bilinear<0, 3, N>(colour, u, v);
  return {Vec3<N>(c[0], c[1], c[2]), d, saturate(N(2.0f) - N(50.0f) * off) * saturate(N(50.0f) * border)};
}
template <class N>
struct Between {
  Vec3<N> colour;
  N depth;
};
template <class N, class Colours, class Depths>
RAINREF_FN Between<N> reprojected(const ReprojectUniforms& r, const Colours& behind, const Depths& behind_depth, const Colours& ahead, const Depths& ahead_depth, int column, int row) {
  const N x = (N::index(column) + N(0.5f)) * N(r.pixel[0]) - N(r.half_size[0]), y = (N(static_cast<float>(row) + 0.5f)) * N(r.pixel[1]) - N(r.half_size[1]);
  // What the picture behind finds is where the search in the one ahead begins.
  const N half(0.5f), here = sample_nearest<0, 1, N>(behind_depth, half + x * uniform_quotient(0.5f, r.half_size[0], N()), half + y * uniform_quotient(0.5f, r.half_size[1], N()))[0];
  const SeenFrom<N> a = seen_from<N>(r, behind, behind_depth, x, y, r.behind_by, here - N(r.behind_by * r.forward[2]), 4);
  if (r.share == 0.0f) return {a.colour, a.depth};
  const SeenFrom<N> b = seen_from<N>(r, ahead, ahead_depth, x, y, r.ahead_by, a.depth, 3);
  const N least(0.02f), weight_a = N(1.0f - r.share) * (a.fits + least), weight_b = N(r.share) * (b.fits + least);
  const N share = weight_b / (weight_a + weight_b);
  return {mix(a.colour, b.colour, share), select(share < N(0.5f), a.depth, b.depth)};
}
