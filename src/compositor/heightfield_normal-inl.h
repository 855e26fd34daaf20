// Normals of a heightfield, written once for any number type N of doubles. Text only; include math/vocabulary-inl.h and a fetch from floats
// before it. Vertices and cells have whole x and y.

template <class N>
RAINREF_FN Vec3<N> made_unit(const Vec3<N>& a) {
  const N size = length(a);
  return Vec3<N>{a.x / size, a.y / size, a.z / size};
}
/// The unit normal for slopes in cells (height per column, per row).
template <class N>
RAINREF_FN Vec3<N> normal_of_slopes(const HeightfieldView& field, N slope_x, N slope_y) {
  const auto row = [&](int k) RAINREF_LAMBDA { return Vec3<N>{N(field.to_grid[k][0]), N(field.to_grid[k][1]), N(field.to_grid[k][2])}; };
  return made_unit(row(2) - slope_x * row(0) - slope_y * row(1));
}
template <class N>
RAINREF_FN N height_of_vertex(const HeightfieldView& field, typename N::Int x, typename N::Int y) {
  return fetch(field.heights, y * N::uniform_int(static_cast<int>(field.columns) + 1) + x, N());
}

/// Normal of the triangle of cell (x, y) selected by `upper`: 1 for the side of the fourth vertex, else 0.
template <class N>
RAINREF_FN Vec3<N> facet_normal(const HeightfieldView& field, typename N::Int x, typename N::Int y, typename N::Int upper) {
  const auto along = y + upper, across = x + upper;
  return normal_of_slopes(field, height_of_vertex<N>(field, x + 1, along) - height_of_vertex<N>(field, x, along),
                          height_of_vertex<N>(field, across, y + 1) - height_of_vertex<N>(field, across, y));
}

/// Normal of a vertex, by central differences.
template <class N>
RAINREF_FN Vec3<N> vertex_normal(const HeightfieldView& field, typename N::Int x, typename N::Int y) {
  const auto none = N::uniform_int(0);
  const auto west = max_index(x + -1, none), east = clamp_index(x + 1, N::uniform_int(static_cast<int>(field.columns) + 1));
  const auto south = max_index(y + -1, none), north = clamp_index(y + 1, N::uniform_int(field.rows + 1));
  const N slope_x = (height_of_vertex<N>(field, east, y) - height_of_vertex<N>(field, west, y)) / (to_number(east) - to_number(west));
  const N slope_y = (height_of_vertex<N>(field, x, north) - height_of_vertex<N>(field, x, south)) / (to_number(north) - to_number(south));
  return normal_of_slopes(field, slope_x, slope_y);
}
/// Vertex normals of cell (x, y), interpolated to (u, v) in it and normalized.
template <class N>
RAINREF_FN Vec3<N> interpolated_normal(const HeightfieldView& field, typename N::Int x, typename N::Int y, N u, N v) {
  const N one(1.0);
  const Vec3<N> south = (one - u) * vertex_normal<N>(field, x, y) + u * vertex_normal<N>(field, x + 1, y);
  const Vec3<N> north = (one - u) * vertex_normal<N>(field, x, y + 1) + u * vertex_normal<N>(field, x + 1, y + 1);
  return made_unit((one - v) * south + v * north);
}
