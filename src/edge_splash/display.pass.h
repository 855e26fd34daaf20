// Pass display: linear radiance to sRGB codes.

template <class N>
RAINREF_FN Vec3<N> display(const DisplayUniforms& u, const Vec3<N>& colour) {
  const Vec3<N> c = N(u.exposure) * colour;
  return encode_srgb(Vec3<N>(saturate(c.x), saturate(c.y), saturate(c.z)));
}
