// Pass raindrops, as published: drop i of the frame (seed 003, getRaindrops; hash22 as printed, hash12 by Dave Hoskins,
// which the article calls without printing it).

template <class N>
struct Pair {
  N x, y;
};
template <class N>
RAINREF_FN Pair<N> hash22(N x, N y) {
  const Vec3<N> p3(fract(x * N(0.1031f)), fract(y * N(0.1030f)), fract(x * N(0.0973f)));
  const N d = dot(p3, Vec3<N>(p3.y + N(33.33f), p3.z + N(33.33f), p3.x + N(33.33f)));
  const Vec3<N> q(p3.x + d, p3.y + d, p3.z + d);
  return {fract((q.x + q.y) * q.z), fract((q.x + q.z) * q.y)};
}
template <class N>
RAINREF_FN N hash12(N x, N y) {
  const Vec3<N> p3(fract(x * N(0.1031f)), fract(y * N(0.1031f)), fract(x * N(0.1031f)));
  const N d = dot(p3, Vec3<N>(p3.y + N(33.33f), p3.z + N(33.33f), p3.x + N(33.33f)));
  const Vec3<N> q(p3.x + d, p3.y + d, p3.z + d);
  return fract((q.x + q.y) * q.z);
}

/// x, y [texels] and the activated strength of drop i.
template <class N>
RAINREF_FN Vec3<N> raindrop_as_published(const RaindropsUniforms& u, int i) {
  const N t = N(u.time) * N(u.rain_speed), base_time = floor(t);
  const N offset = N::index(i) * N(0.3711f);
  const N seed_x = base_time + offset, seed_y = N::index(i) * N(17.3f);
  const Pair<N> place = hash22(seed_x, seed_y);
  const N strength = N(u.drop_intensity) * (N(0.5f) + N(0.5f) * hash12(seed_x + N(1.0f), seed_y + N(1.0f)));
  const N pulse = fract(t + offset * N(0.7f));
  const N activation = smoothstep(0.0f, 0.15f, pulse) * smoothstep(0.35f, 0.2f, pulse);
  return Vec3<N>(place.x * N(u.width), place.y * N(u.height), strength * activation);
}
