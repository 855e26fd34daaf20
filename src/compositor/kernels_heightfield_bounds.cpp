// Bounds of the heights of a heightfield's cells; compiled once for each SIMD target.
#include <algorithm>
#include <limits>

#include "compositor/heightfield_view.h"

#define RAINREF_KERNELS "compositor/kernels_heightfield_bounds.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(compositor)

constexpr int width = static_cast<int>(hn::MaxLanes(Lanes::D()));

HWY_INLINE HWY_ATTR float highest_of(Lanes x) {
  HWY_ALIGN float lanes[width];
  hn::Store(x.v, Lanes::D(), lanes);
  return *std::max_element(lanes, lanes + width);
}

void SummarizeTile(const float* heights, int columns, float* highest, float* pairs, HeightfieldTile& tile) {
  const int x0 = static_cast<int>(tile.x0), x1 = static_cast<int>(tile.x1);
  const std::size_t stride = static_cast<std::size_t>(columns) + 1;
  Lanes lowest(heights[static_cast<std::size_t>(tile.y0) * stride + static_cast<std::size_t>(x0)]), high = lowest, steepest(0.0f);
  for (auto y = static_cast<std::size_t>(tile.y0); y < static_cast<std::size_t>(tile.y1); ++y) {
    const float *a = heights + y * stride, *b = a + stride;
    float *to = highest + y * stride, *two = pairs + 2 * y * stride;
    int x = x0;
    for (; x + width <= x1; x += width) {
      const Lanes h00 = Lanes::load(a + x), h10 = Lanes::load(a + x + 1), h01 = Lanes::load(b + x), h11 = Lanes::load(b + x + 1);
      const Lanes top = max(max(h00, h10), max(h01, h11));
      hn::StoreU(top.v, Lanes::D(), to + x);
      hn::StoreInterleaved2(h00.v, h01.v, Lanes::D(), two + 2 * x);
      lowest = min(lowest, min(min(h00, h10), min(h01, h11)));
      high = max(high, top);
      steepest = max(steepest, max(max(abs(h10 - h00), abs(h01 - h00)), max(abs(h11 - h10), abs(h11 - h01))));
    }
    for (; x < x1; ++x) {
      const auto [least, most] = std::minmax({a[x], a[x + 1], b[x], b[x + 1]});
      to[x] = most;
      two[2 * x] = a[x];
      two[2 * x + 1] = b[x];
      lowest = min(lowest, Lanes(least));
      high = max(high, Lanes(most));
      steepest = max(steepest, Lanes(most - least));
    }
    if (x1 == columns) {
      two[2 * x1] = a[x1];
      two[2 * x1 + 1] = b[x1];
    }
  }
  tile.low = -static_cast<double>(highest_of(-lowest));
  tile.high = static_cast<double>(highest_of(high));
  tile.steepest = static_cast<double>(highest_of(steepest));
}

void SummarizeBlocks(const float* highest, int columns, int rows, float* blocks) {
  const std::size_t stride = static_cast<std::size_t>(columns) + 1;
  static_assert(width % block_cells == 0 || block_cells % width == 0);
  constexpr int step = std::max(width, block_cells);
  HWY_ALIGN float tops[step];
  int x = 0;
  for (; x + step <= columns; x += step) {
    for (int k = 0; k < step; k += width) {
      Lanes top = Lanes::load(highest + x + k);
      for (int y = 1; y < rows; ++y)
        top = max(top, Lanes::load(highest + static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x + k)));
      hn::Store(top.v, Lanes::D(), tops + k);
    }
    for (int k = 0; k < step; k += block_cells) blocks[(x + k) / block_cells] = *std::max_element(tops + k, tops + k + block_cells);
  }
  for (; x < columns; x += block_cells) {
    float top = -std::numeric_limits<float>::infinity();
    for (int y = 0; y < rows; ++y) {
      const float* row = highest + static_cast<std::size_t>(y) * stride;
      top = std::max(top, *std::max_element(row + x, row + std::min(x + block_cells, columns)));
    }
    blocks[x / block_cells] = top;
  }
}

RAINREF_TARGET_END(compositor)

#if RAINREF_ONCE
namespace rainref::compositor {

RAINREF_EXPORT(SummarizeTile);
RAINREF_EXPORT(SummarizeBlocks);

void summarize_tile(const float* heights, int columns, float* highest, float* pairs, HeightfieldTile& tile) {
  RAINREF_DISPATCH(SummarizeTile)(heights, columns, highest, pairs, tile);
}
void summarize_blocks(const float* highest, int columns, int rows, float* blocks) {
  RAINREF_DISPATCH(SummarizeBlocks)(highest, columns, rows, blocks);
}

}  // namespace rainref::compositor
#endif
