// Optics at a smooth dielectric surface, written once for any number type N. Text only; include vocabulary-inl.h before it.

/// Schlick's approximation: f0 + (1 - f0) (1 - cos)^5, cos in [0, 1]; f0 is the reflectance at normal incidence.
template <class N>
RAINREF_FN N fresnel_schlick(N cosine, float f0) {
  const N m = N(1.0f) - cosine, m2 = square(m);
  return N(f0) + N(1.0f - f0) * (square(m2) * m);
}
/// Fresnel's reflectance of unpolarized light, cos_i in [0, 1], eta = n_t / n_i >= 1:
///   r_par = (eta cos_i - cos_t) / (eta cos_i + cos_t), r_perp = (cos_i - eta cos_t) / (cos_i + eta cos_t).
/// The ratio is a float, or a double if N accepts one.
template <class N, class Ratio>
RAINREF_FN N fresnel_dielectric(N cos_i, Ratio eta) {
  const N sin2_t = (N(1.0f) - square(cos_i)) * N(1.0f / (eta * eta));
  const N cos_t = sqrt(guard<N>(max(N(1.0f) - sin2_t, N(0.0f)), "the sine is below 1: the other side is denser"));
  const N e(eta), tiny(1e-20f);
  constexpr const char* is_large = "the denominator is at least the cosine of the refracted ray";
  const N parallel = (e * cos_i - cos_t) / guard<N>(max(e * cos_i + cos_t, tiny), is_large);
  const N perpendicular = (cos_i - e * cos_t) / guard<N>(max(cos_i + e * cos_t, tiny), is_large);
  return N(0.5f) * (square(parallel) + square(perpendicular));
}
/// Beer's law: exp(-extinction * path).
template <class N>
RAINREF_FN N transmittance(N extinction, N path) {
  return exp(-(extinction * path));
}

/// Linear radiance to sRGB code values, components in [0, 1] (IEC 61966-2-1).
template <class N>
RAINREF_FN Vec3<N> encode_srgb(const Vec3<N>& c) {
  const N knee(0.0031308f), slope(12.92f);
  const Vec3<N> power = pow(Vec3<N>{max(c.x, knee), max(c.y, knee), max(c.z, knee)}, N(0x1.aaaaaap-2f));  // 1 / 2.4
  const Vec3<N> curve = N(1.055f) * power - Vec3<N>{N(0.055f), N(0.055f), N(0.055f)};
  return Vec3<N>{select(c.x <= knee, c.x * slope, curve.x), select(c.y <= knee, c.y * slope, curve.y),
                 select(c.z <= knee, c.z * slope, curve.z)};
}
/// The same for any radiance, clamped to [0, 1] first.
template <class N>
RAINREF_FN Vec3<N> display_code(const Vec3<N>& c) {
  constexpr const char* is_light = "radiance is nowhere negative";
  return encode_srgb(
      Vec3<N>{guard_below<N>(saturate(c.x), is_light), guard_below<N>(saturate(c.y), is_light), guard_below<N>(saturate(c.z), is_light)});
}
