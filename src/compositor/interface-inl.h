// Reflection and refraction at a smooth interface between two media, written once for any number type N of doubles. Text only; include
// math/optics-inl.h before it.

/// The two rays that result at an interface; directions are unit vectors.
template <class N>
struct SplitOf {
  Vec3<N> reflected, refracted;  ///< refracted is zero beyond the critical angle
  N reflectance;                 ///< Fresnel's, for unpolarized light, in [0, 1]; 1 beyond the critical angle
};
/// d and n are unit, n against d; ior_from is on the ray's side. Accurate to a few roundings.
template <class N>
RAINREF_FN SplitOf<N> split(const Vec3<N>& d, const Vec3<N>& n, N ior_from, N ior_to) {
  const Vec3<N> bent = refract(d, n, ior_from / ior_to);
  const N zero(0.0), one(1.0);
  const auto is_zero = [&](N x) RAINREF_LAMBDA { return (x <= zero) & (x >= zero); };
  const auto beyond_critical = is_zero(bent.x) & is_zero(bent.y) & is_zero(bent.z);
  // Fresnel's equations are symmetric; the text needs them from the thinner medium.
  const auto from_thinner = ior_from <= ior_to;
  const N cosine = select(from_thinner, -dot(n, d), -dot(n, bent)), ratio = select(from_thinner, ior_to / ior_from, ior_from / ior_to);
  return {reflect(d, n), bent, select(beyond_critical, one, fresnel_dielectric(cosine, ratio))};
}

/// The rays, and the normal that was used, against the ray.
template <class N>
struct CrossingOf {
  SplitOf<N> rays;
  Vec3<N> normal;
};
/// facing and smooth are unit, facing against the ray. If the smooth normal would send a ray through the facet, facing is used.
template <class N>
RAINREF_FN CrossingOf<N> cross_facet(const Vec3<N>& d, const Vec3<N>& facing, const Vec3<N>& smooth, N ior_from, N ior_to) {
  const N zero(0.0);
  const SplitOf<N> rays = split(d, smooth, ior_from, ior_to);
  const auto holds = (dot(d, smooth) < zero) & (dot(rays.reflected, facing) > zero) & !(dot(rays.refracted, facing) > zero);
  if (!any(!holds)) return {rays, smooth};
  const SplitOf<N> of_facet = split(d, facing, ior_from, ior_to);
  return {{select(holds, rays.reflected, of_facet.reflected), select(holds, rays.refracted, of_facet.refracted),
           select(holds, rays.reflectance, of_facet.reflectance)},
          select(holds, smooth, facing)};
}
