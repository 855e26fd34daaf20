// Finds touching drops with a grid of cells for each class of sizes, so that the work is proportional to the number of drops even if their
// sizes differ much.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "drops/drops.h"
#include "drops/motion/bucket_sort.h"
#include "drops/uniforms.h"
#include "rainref/executor.h"

namespace rainref::drops {

/// Class k holds masses in [8^k, 8^(k + 1)): radii differ by less than a factor of 2. 2^24 is in class 8.
constexpr int size_classes = 9;
constexpr int size_class_of(float mass) {
  int k = 0;
  for (float limit = 8; k + 1 < size_classes && mass >= limit; limit *= 8) ++k;
  return k;
}

/// A grid over the glass. If two drops touch and the larger is of this class, they are in the same or in neighbouring cells; drops beyond
/// the edge belong to the cells at the edge.
struct ClassGrid {
  double x0 = 0, y0 = 0, inverse_side = 0;
  int columns = 0, rows = 0;  ///< 0: the class has no drops
  std::uint32_t first_cell = 0;
  int column(float x) const { return place(x - x0, columns); }
  int row(float y) const { return place(y - y0, rows); }

 private:
  int place(double from_edge, int count) const {
    const double k = from_edge * inverse_side;
    return k < 1 ? 0 : k >= count ? count - 1 : static_cast<int>(k);
  }
};

/// The live drops sorted by class and cell.
struct MergeGrid {
  std::array<ClassGrid, size_classes> classes;
  std::vector<std::uint32_t> cell_start;  ///< one more entry than cells
  std::vector<float> x, y, radius, mass;  ///< with room for a vector after the last entry
  std::vector<std::uint32_t> id, slot;
  std::int64_t count = 0;

  void build(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms);

 private:
  void lay_out(const std::array<std::int64_t, size_classes>& counts, const MergeUniforms& uniforms);
  void sort(const parallel::Executor& executor, const DropArrays& drops);

  std::vector<float> slot_x_, slot_y_, slot_radius_;
  std::vector<std::uint32_t> slot_cell_;
  BucketSort by_cell_;
};

}  // namespace rainref::drops
