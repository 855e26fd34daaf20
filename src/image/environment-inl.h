// Looks up radiance by direction, written once for any number type N. Text only; include sampling-inl.h before it.
//
// Latitude/longitude: u = 1/2 + atan2(z, x) / 2 pi, v = 1/2 + asin(y) / pi; row 0 (v = 0) looks straight down. Address repeat in u, clamp
// in v; four channels.
// Cube: six square faces above each other in one image, in the order +x -x +y -y +z -z, each oriented as graphics APIs orient the faces of
// a cube map (s, t from the table below, t = 0 at the face's first row). Lookups stay inside the face: no filtering over its edges.
//   face   s     t          face   s     t
//   +x    -z    -y           -x    +z    -y
//   +y    +x    +z           -y    +x    -z
//   +z    +x    -y           -z    -x    -y

template <class N, class T>
RAINREF_FN Vec3<N> sample_latlong(const T& t, const Vec3<N>& d, N lod) {
  const Two<N> angle = atan2(Two<N>(d.z, d.y), Two<N>{d.x, sqrt(square(d.x) + square(d.z))});
  const N u = N(0.5f) + angle.a * N(0x1.45f306p-3f);  // 1 / (2 pi)
  const N v = N(0.5f) + angle.b * N(0x1.45f306p-2f);  // 1 / pi
  const auto texel = sample_trilinear<0, 3, N>(t, u, v, lod);
  return Vec3<N>(texel[0], texel[1], texel[2]);
}
template <class N, class T>
RAINREF_FN Vec3<N> sample_latlong(const T& t, const Vec3<N>& d) {
  return sample_latlong(t, d, N(0.0f));
}

template <class N, class T>
RAINREF_FN Vec3<N> sample_cube(const T& t, const Vec3<N>& d, N lod) {
  const N ax = abs(d.x), ay = abs(d.y), az = abs(d.z), zero(0.0f), one(1.0f);
  const auto x_major = (ax >= ay) & (ax >= az), y_major = (ay >= az) & !x_major;
  const auto negative_x = d.x < zero, negative_y = d.y < zero, negative_z = d.z < zero;
  const N major = max(max(ax, ay), max(az, N(1e-20f)));
  const N sx = select(negative_x, d.z, -d.z), sy = d.x, sz = select(negative_z, -d.x, d.x);
  const N tx = -d.y, ty = select(negative_y, -d.z, d.z), tz = -d.y;
  const N s = select(x_major, sx, select(y_major, sy, sz)) / major, r = select(x_major, tx, select(y_major, ty, tz)) / major;
  const N face = select(x_major, select(negative_x, one, zero),
                        select(y_major, select(negative_y, N(3.0f), N(2.0f)), select(negative_z, N(5.0f), N(4.0f))));
  // The nearest level, because the faces of a level must keep whole rows.
  const N level =
      floor(guard<N>(clamp(lod, zero, N(static_cast<float>(t.levels - 1))), "the host asks for a level that there is") + N(0.5f));
  const Level<N> l = level_of<N>(t, to_int(level));
  const N side = l.width_number, edge = N(0.5f) / side;
  const N fu = clamp(s * N(0.5f) + N(0.5f), edge, one - edge), fv = clamp(r * N(0.5f) + N(0.5f), edge, one - edge);
  const auto texel = sample_level<0, 3, N>(t, l, fu, (face + fv) / N(6.0f));
  return Vec3<N>(texel[0], texel[1], texel[2]);
}

template <class N>
RAINREF_FN Vec3<N> sample_environment(const Texture& t, bool is_cube, const Vec3<N>& d, N lod) {
  return is_cube ? sample_cube(fixed_texture<Address::clamp, Address::clamp, 4>(t), d, lod)
                 : sample_latlong(fixed_texture<Address::repeat, Address::clamp, 4>(t), d, lod);
}
