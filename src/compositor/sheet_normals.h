// Normals of heightfields at many hits at once, in lanes of doubles.
#pragma once

#include "compositor/heightfield_view.h"

namespace rainref::compositor {

/// Heightfield::normal and Heightfield::smooth_normal for each hit. Hits are padded to whole lanes by repeating the last one; whole lanes
/// are written.
void facet_normals(const HeightfieldView& field, std::size_t count, const Hit* hits, const VecArraysOut& normals);
void interpolated_normals(const HeightfieldView& field, std::size_t count, const Hit* hits, const VecArraysOut& normals);

/// A level heightfield's downhill slopes at its vertices, in pairs along x and along z: rows of columns + 1 vertices.
struct SlopeView {
  const float* slopes;
  int columns;
};
/// The unit normals from slopes interpolated to the hits, the y axis up; otherwise as above.
void normals_of_interpolated_slopes(const SlopeView& sheet, std::size_t count, const Hit* hits, const VecArraysOut& normals);

}  // namespace rainref::compositor
