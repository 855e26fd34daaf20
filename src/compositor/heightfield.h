// A heightfield over a parallelogram: water, or the drops on a flat pane.
#pragma once

#include <span>
#include <vector>

#include "base/zeroed.h"
#include "compositor/sheet_normals.h"
#include "compositor/surface.h"
#include "rainref/executor.h"

namespace rainref::compositor {

/// Vertex (x, y) of height h lies at origin + x / columns edge_u + y / rows edge_v + h axis. The three directions must
/// span space; the outside is where the axis points. For water at y = 0: axis (0, 1, 0), heights in metres.
struct HeightfieldFrame {
  Vec origin, edge_u, edge_v, axis;
};

/// Cells of two triangles each, with the diagonal from vertex (x + 1, y) to (x, y + 1); a ray meets the sheet from both sides. No ray
/// passes between two cells; the sheet is open at its border. Exact as far as a ray's origin lies within 10^6 cells of the sheet.
///
/// A hit's part is 2 (y columns + x) + upper, where the upper triangle holds vertex (x + 1, y + 1); its u and v in [0, 1] count from vertex
/// (x, y) along u and v. If a ray crosses the sheet several times, the first crossing counts.
class Heightfield final : public Surface {
 public:
  /// A flat sheet of height 0. Throws Error(usage) unless columns and rows are positive, their product is below 2^30, the
  /// frame spans space and tile_cells is positive.
  Heightfield(const HeightfieldFrame& frame, int columns, int rows, int tile_cells = 128);

  Heightfield(const Heightfield&) = delete;
  Heightfield& operator=(const Heightfield&) = delete;

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  /// Takes the (columns + 1)(rows + 1) finite heights of all vertices, row by row. Throws Error(internal) for another count.
  void assign(std::span<const float> heights, const parallel::Executor& executor);
  std::span<const float> heights() const { return heights_; }

  /// Columns and rows from vertex (0, 0) to the hit, both with fractions.
  struct Place {
    double x, y;
  };
  Place place(const Hit& hit) const;
  /// The unit normal for slopes in cells (height per column, per row), on the outside.
  Vec normal_of_slopes(double slope_x, double slope_y) const;
  /// Normals of the vertices by central differences, interpolated to the hit and normalized.
  Vec smooth_normal(const Hit& hit) const;
  /// The same for `count` hits, padded to whole lanes by repeating the last one.
  void smooth_normals(std::size_t count, const Hit* hits, const VecArraysOut& normals) const {
    interpolated_normals(view_, count, hits, normals);
  }

  std::uint64_t revision() const override { return revision_; }
  std::uint32_t primitives() const override { return static_cast<std::uint32_t>(tiles_.size()); }
  Box bounds(std::uint32_t primitive) const override;
  void meet(std::uint32_t self, std::uint32_t primitive, const Ray& ray, Hit& first) const override;
  std::uint32_t meet_packet(std::uint32_t self, std::uint32_t primitive, std::uint32_t lanes, Packet& packet) const override;
  Vec normal(const Ray& ray, const Hit& hit) const override;
  void normals(const RayArrays& rays, std::span<const std::uint32_t> which, const Hit* hits, const VecArraysOut& normals) const override;

 private:
  HeightfieldFrame frame_;
  int columns_, rows_;
  double cell_height_;      ///< longer side of a cell, in units of the axis
  std::size_t first_cell_;  ///< of highest_, which has spare cells on both sides
  int blocks_across_, blocks_down_;
  zeroed::Array<float> memory_;  ///< one block for the next three, so that a few large pages hold it instead of one small page per row
  std::span<float> heights_, pairs_, highest_;  ///< see HeightfieldView
  std::vector<float> blocks_, nearby_;          ///< maximum of each block alone, and with the blocks around it
  std::vector<HeightfieldTile> tiles_;
  HeightfieldView view_;
  std::uint64_t revision_ = 0;
};

}  // namespace rainref::compositor
