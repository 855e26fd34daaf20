// A view from a position between two pictures, one taken behind it and one ahead. The point seen along (x, y, 1) at depth d is at P = d (x,
// y, 1) + way in a picture's camera, where the picture holds a depth D, which should be d + way.z. One step of
//   d + (D - way.z - d) d / max(d, d + way.z)
// finds d exactly on level ground, where a plain fixed-point step diverges; other surfaces need a few steps. If D is not as it should be,
// something hid the point in that picture, and the other one is used.
// A search must wait for each lookup, so several run side by side, vector by vector.

template <class N, int Count>
struct Searches {
  N x[Count];
  N y;
  N d[Count], u[Count], v[Count], there[Count];  ///< depth; its position in the picture, and the picture's depth there
  RAINREF_FN Searches() {}
};
template <class N, int Count, class Depths>
RAINREF_FN void search(const ReprojectUniforms& r, const Depths& depth, float way, int rounds, Searches<N, Count>& s) {
  const N half(0.5f), one(1.0f), su = uniform_quotient(0.5f, r.half_size[0], N()), sv = uniform_quotient(0.5f, r.half_size[1], N()),
                                 nearest(0.5f);
  const N wx = N(way * r.forward[0]), wy = N(way * r.forward[1]), wz = N(way * r.forward[2]);
  for (int k = 0; k < Count; ++k) s.d[k] = max(s.d[k], nearest);
  for (int round = 0; round < rounds; ++round) {
    for (int k = 0; k < Count; ++k) {
      const N d = s.d[k], deep = one / max(d + wz, nearest);
      s.u[k] = half + ((d * s.x[k] + wx) * deep) * su;
      s.v[k] = half + ((d * s.y + wy) * deep) * sv;
      N there = sample_nearest<0, 1, N>(depth, s.u[k], s.v[k])[0];
      // The last two rounds interpolate between texels that lie on one surface: depths of whole rows would shift the road's texture row by
      // row.
      if (round + 2 >= rounds) {
        const N smooth = sample_bilinear<0, 1, N>(depth, s.u[k], s.v[k])[0];
        there = select(abs(smooth - there) < N(0.05f) * there, smooth, there);
      }
      s.there[k] = there;
      if (round + 1 < rounds) s.d[k] = max(d + (way > 0 ? (d * deep) * (there - wz - d) : there - wz - d), nearest);
    }
  }
}
template <class N>
struct SeenFrom {
  Vec3<N> colour;
  N fits;  ///< in [0, 1]: whether the picture shows the point
};
template <class N, int Count, class Colours>
RAINREF_FN SeenFrom<N> seen(const ReprojectUniforms& r, const Colours& colour, float way, const Searches<N, Count>& s, int k) {
  const N one(1.0f), off = abs(s.there[k] - N(way * r.forward[2]) - s.d[k]) / s.d[k],
                     border = min(min(s.u[k], one - s.u[k]), min(s.v[k], one - s.v[k]));
  const auto c = sample_bilinear<0, 3, N>(colour, s.u[k], s.v[k]);
  return {Vec3<N>(c[0], c[1], c[2]), saturate(N(2.0f) - N(50.0f) * off) * saturate(N(50.0f) * border)};
}
template <class N>
struct Between {
  Vec3<N> colour;
  N depth;
};
/// Count vectors of a row, from `column` on; use(k, Between) is called with the k-th.
template <class N, int Count, class Colours, class Depths, class Use>
RAINREF_FN void reprojected(const ReprojectUniforms& r, const Colours& behind, const Depths& behind_depth, const Colours& ahead,
                            const Depths& ahead_depth, int column, int row, const Use& use) {
  const N half(0.5f), su = uniform_quotient(0.5f, r.half_size[0], N()), sv = uniform_quotient(0.5f, r.half_size[1], N());
  Searches<N, Count> a, b;
  a.y = b.y = (N(static_cast<float>(row) + 0.5f)) * N(r.pixel[1]) - N(r.half_size[1]);
  for (int k = 0; k < Count; ++k) {
    a.x[k] = b.x[k] = (N::index(column + k * N::size()) + N(0.5f)) * N(r.pixel[0]) - N(r.half_size[0]);
    a.d[k] = sample_nearest<0, 1, N>(behind_depth, half + a.x[k] * su, half + a.y * sv)[0] - N(r.behind_by * r.forward[2]);
  }
  search(r, behind_depth, r.behind_by, 4, a);
  if (r.share == 0.0f) {
    for (int k = 0; k < Count; ++k) use(k, Between<N>{seen(r, behind, r.behind_by, a, k).colour, a.d[k]});
    return;
  }
  // The result of the picture behind is the start of the search in the one ahead.
  for (int k = 0; k < Count; ++k) b.d[k] = a.d[k];
  search(r, ahead_depth, r.ahead_by, 3, b);
  for (int k = 0; k < Count; ++k) {
    const SeenFrom<N> from = seen(r, behind, r.behind_by, a, k), to = seen(r, ahead, r.ahead_by, b, k);
    const N least(0.02f), weight_a = N(1.0f - r.share) * (from.fits + least), weight_b = N(r.share) * (to.fits + least);
    const N share = weight_b / (weight_a + weight_b);
    use(k, Between<N>{mix(from.colour, to.colour, share), select(share < N(0.5f), a.d[k], b.d[k])});
  }
}
