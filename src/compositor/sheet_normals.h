// Normals of sheets at many hits at once, evaluated in lanes of doubles.
#pragma once

#include "compositor/heightfield_view.h"

namespace rainref::compositor {

/// Heightfield::normal and Heightfield::smooth_normal of each hit. Hits go on to whole lanes, repeating the last one; whole lanes are
/// written.
void facet_normals(const HeightfieldView& field, std::size_t count, const Hit* hits, const VecArraysOut& normals);
void interpolated_normals(const HeightfieldView& field, std::size_t count, const Hit* hits, const VecArraysOut& normals);

/// A level sheet's slopes downhill at its vertices, in pairs along x and along z: rows of columns + 1 vertices.
struct SlopeView {
  const float* slopes;
  int columns;
};
/// The unit normals where slopes are interpolated to the hits, the y axis up; otherwise as above.
void normals_of_interpolated_slopes(const SlopeView& sheet, std::size_t count, const Hit* hits, const VecArraysOut& normals);

}  // namespace rainref::compositor
