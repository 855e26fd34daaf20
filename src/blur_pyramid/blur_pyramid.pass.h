// Pass blur_pyramid: the fogged scene, then each level from the one above. Needs optics-inl.h.

/// Level 0: fog (1 - T) + colour T, T = exp(-density depth).
template <class N>
RAINREF_FN Vec3<N> fogged(const BlurUniforms& u, const Vec3<N>& colour, N depth) {
  return mix(Vec3<N>(u.fog_colour), colour, transmittance(N(u.fog_density), max(depth, N(0.0f))));
}

/// as-published: a box of 2 x 2 texels. With an odd size the last column or row of the level above is dropped.
template <class N>
RAINREF_FN N box_of_four(N a, N b, N c, N d) {
  return N(0.25f) * sum_any_order_in_pairs(a, b, c, d);
}

/// corrected: a texel of m covers 1 / m of the n texels above, so with n = 2 m + 1 three of them, weighted by the overlap:
/// (m - x) / n, m / n, (x + 1) / n. Every texel above counts the same in sum, so the mean is kept. Written from the first
/// tap on, so that a constant stays as it is. Columns are taken together first, then rows of that.
template <class N>
RAINREF_FN N box_of_three(N t0, N t1, N t2, N w1, N w2) {
  return (t0 + w1 * (t1 - t0)) + w2 * (t2 - t0);
}
/// The weight of the last tap for output index x.
template <class N>
RAINREF_FN N last_weight(float last, N x) {
  return N(last) * (x + N(1.0f));
}

/// Output texel (x, y), one channel; tap(i, j) is input texel (2 x + i, 2 y + j), the nearest one where there is none.
template <class N, class Tap>
RAINREF_FN N halved_as_published(Tap tap) {
  return box_of_four(tap(0, 0), tap(1, 0), tap(0, 1), tap(1, 1));
}
template <class N, class Tap>
RAINREF_FN N halved_corrected(const BlurUniforms& u, Tap tap, int x, int y) {
  const N wy1(u.middle[1]), wy2 = last_weight(u.last[1], N(static_cast<float>(y)));
  const auto column = [&](int i) RAINREF_LAMBDA { return box_of_three(tap(i, 0), tap(i, 1), tap(i, 2), wy1, wy2); };
  return box_of_three(column(0), column(1), column(2), N(u.middle[0]), last_weight(u.last[0], N::index(x)));
}
