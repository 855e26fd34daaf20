// Pass normals: the normal of the water from its height, by central differences.
//
//   normal = normalize(-slope_x, -slope_y, 1) in axes of the glass: x along u, y in the glass across it, z outward
//
// as-published reduces each tap by the wiper mask there, which makes a slope of the mask's own edge (-height grad mask);
// corrected reduces the slope. Rows are readable one texel to both sides, where the nearest texel stands again.

/// Stored heights [mm] and masks of three rows.
template <class Storage>
struct SurfaceRows {
  const Storage *below, *here, *above;
  const Storage *mask_below, *mask_here, *mask_above;
};

/// From differences across two texels.
template <class N>
RAINREF_FN Vec3<N> normal_of(const NormalsUniforms& u, N across_columns, N across_rows, N kept) {
  const N slope_x = kept * (N(u.slope_x) * across_columns);
  const N slope_y = kept * (N(u.slope_shear) * across_columns + N(u.slope_y) * across_rows);
  return normalize(Vec3<N>(-slope_x, -slope_y, N(1.0f)));
}
template <class N, class Storage>
RAINREF_FN N masked_tap(const Storage* height, const Storage* mask, int x) { return N::load(height + x) * (N(1.0f) - N::load(mask + x)); }
template <class N, class Storage>
RAINREF_FN Vec3<N> normal_as_published(const NormalsUniforms& u, const SurfaceRows<Storage>& in, int x) {
  const N across_columns = masked_tap<N>(in.here, in.mask_here, x + 1) - masked_tap<N>(in.here, in.mask_here, x - 1);
  const N across_rows = masked_tap<N>(in.above, in.mask_above, x) - masked_tap<N>(in.below, in.mask_below, x);
  return normal_of(u, across_columns, across_rows, N(1.0f));
}
template <class N, class Storage>
RAINREF_FN Vec3<N> normal_corrected(const NormalsUniforms& u, const SurfaceRows<Storage>& in, int x) {
  const N across_columns = N::load(in.here + x + 1) - N::load(in.here + x - 1);
  const N across_rows = N::load(in.above + x) - N::load(in.below + x);
  return normal_of(u, across_columns, across_rows, N(1.0f) - N::load(in.mask_here + x));
}
