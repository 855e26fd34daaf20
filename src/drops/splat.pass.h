// Pass splat: the height of the water on the glass [mm], texel by texel.
//
//   height = film + drops in slot order,    a drop gives h kernel(q),    q = |distance in the plane of the glass| / R
//
// R and h grow as the cube root of the mass. as-published measures each axis by its own length, so frame[1] is 0 there;
// corrected measures in the plane, where a drop is round on sheared glass too.

/// A drop as it is drawn: centre [texel], radius [m], height [mm], 0 for a dead one.
template <class N>
struct Stamp {
  N x, y, radius, inverse_radius_sq, height;
  RAINREF_FN Stamp() {}
};
/// x / max(x, least): the share of a drop's own radius in the one that it is drawn with.
template <class N>
RAINREF_FN N over_larger(N x, float least) {
  return x / max(x, N(least));
}
template <class N>
RAINREF_FN Stamp<N> splat_stamp(const SplatUniforms& u, N position_u, N position_v, N mass, N life) {
  Stamp<N> s;
  s.x = position_u * N(u.size[0]);
  s.y = position_v * N(u.size[1]);
  const N root = pow(max(mass, N(0.0f)), N(1.0f / 3.0f)), own = N(u.radius_scale) * root;
  s.radius = max(own, N(u.smallest_radius));
  s.inverse_radius_sq = N(1.0f) / square(s.radius);
  // A drop drawn wider than it is keeps its volume.
  const N height = (N(u.height_scale) * root) * square(over_larger(own, u.smallest_radius));
  s.height = select(life > N(0.0f), height, N(0.0f));
  return s;
}

/// kernel(q); 0 from q = 1 on, but for the disc, which ends beyond it.
template <class N>
RAINREF_FN N splat_profile(SplatKernel kernel, N q_sq) {
  const N inside = max(N(1.0f) - q_sq, N(0.0f));
  switch (kernel) {
    case SplatKernel::paraboloid:
      return inside;
    case SplatKernel::quartic:
      return square(inside);
    case SplatKernel::smoothstep:
      return N(1.0f) - smoothstep(0.0f, 1.0f, sqrt(q_sq));
    case SplatKernel::hemisphere:
      return sqrt(inside);
    default:
      return select(q_sq <= N(1.0f), N(1.0f), N(0.0f));
  }
}
/// What a drop gives to the texel with its centre at (x, y) [texel].
template <class N>
RAINREF_FN N splat_contribution(const SplatUniforms& u, SplatKernel kernel, const Stamp<N>& s, N x, N y) {
  const N column = x - s.x, row = y - s.y;
  const N plane_x = N(u.frame[0]) * column + N(u.frame[1]) * row, plane_y = N(u.frame[2]) * row;
  return s.height * splat_profile(kernel, (square(plane_x) + square(plane_y)) * s.inverse_radius_sq);
}
template <class N>
RAINREF_FN N splat_blend(SplatBlend blend, N before, N drop) {
  return blend == SplatBlend::max ? max(before, drop) : before + drop;
}

/// The drops in a texel, which has all stamps offered. `blended` gives what the target holds after a drop: with `accumulate = half` its
/// half, else the number itself.
template <class N, class Blended>
RAINREF_FN N splat_drops(const SplatUniforms& u, const Stamp<N>* stamps, int x, int y, Blended blended) {
  const N fx = N::index(x) + N(0.5f), fy = N(static_cast<float>(y) + 0.5f);
  N height(0.0f);
  for (int i = 0; i < u.drop_count; ++i) {
    const N drop = splat_contribution(u, static_cast<SplatKernel>(u.kernel), stamps[i], fx, fy);
    height = blended(splat_blend(static_cast<SplatBlend>(u.blend), height, drop));
  }
  return height;
}

/// corrected: the film, whole mass units in each texel, under a tent of 3 x 3 texels, which keeps its volume. Rows are readable
/// one texel to both sides, where the nearest texel stands again.
template <class N>
RAINREF_FN N film_tent(N before, N here, N after) {
  return N(0.5f) * here + N(0.25f) * (before + after);
}
template <class N>
RAINREF_FN N film_row(const float* row, int x) {
  return film_tent(N::load(row + x - 1), N::load(row + x), N::load(row + x + 1));
}
template <class N>
RAINREF_FN N film_height(const SplatUniforms& u, const float* below, const float* here, const float* above, int x) {
  return N(u.film_scale) * film_tent(film_row<N>(below, x), film_row<N>(here, x), film_row<N>(above, x));
}
