#include "simulation/bloom.h"

#include <algorithm>
#include <utility>

#include "simulation/light_mean.h"

namespace rainref::simulation {
namespace {

LightImage halved(const LightImage& from, const parallel::Executor& executor) {
  LightImage to((from.width + 1) / 2, (from.height + 1) / 2);
  executor.for_tiles(to.width, to.height, to.width, tile_rows, [&](const parallel::Tile& tile) {
    std::vector<float> column(3 * static_cast<std::size_t>(from.width));
    for (int y = tile.y0; y < tile.y1; ++y) {
      const auto at = [&](int i) { return from.row(std::clamp(2 * y + i, 0, from.height - 1)); };
      const float *a = at(-1), *b = at(0), *c = at(1), *d = at(2);
      for (std::size_t i = 0; i < column.size(); ++i) column[i] = (a[i] + d[i] + 3 * (b[i] + c[i])) * 0.125f;
      float* out = to.row(y);
      for (int x = 0; x < to.width; ++x) {
        const auto in = [&](int i) { return column.data() + 3 * std::clamp(2 * x + i, 0, from.width - 1); };
        const float *e = in(-1), *f = in(0), *g = in(1), *h = in(2);
        for (int k = 0; k < 3; ++k) out[3 * x + k] = (e[k] + h[k] + 3 * (f[k] + g[k])) * 0.125f;
      }
    }
  });
  return to;
}

/// Multiplies each texel of `to` by `share` and adds the value there of an image of half the size.
void add_doubled(LightImage& to, float share, const LightImage& from, const parallel::Executor& executor) {
  executor.for_tiles(to.width, to.height, to.width, tile_rows, [&](const parallel::Tile& tile) {
    std::vector<float> column(3 * static_cast<std::size_t>(from.width));
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float* near = from.row(y / 2);
      const float* next = from.row(std::clamp(y / 2 + (y % 2 == 0 ? -1 : 1), 0, from.height - 1));
      for (std::size_t i = 0; i < column.size(); ++i) column[i] = 0.75f * near[i] + 0.25f * next[i];
      float* out = to.row(y);
      for (int x = 0; x < to.width; ++x) {
        const float* here = column.data() + 3 * (x / 2);
        const float* beside = column.data() + 3 * std::clamp(x / 2 + (x % 2 == 0 ? -1 : 1), 0, from.width - 1);
        for (int k = 0; k < 3; ++k) out[3 * x + k] = share * out[3 * x + k] + (0.75f * here[k] + 0.25f * beside[k]);
      }
    }
  });
}

}  // namespace

LightImage bloomed(LightImage picture, int levels, const parallel::Executor& executor) {
  std::vector<LightImage> level;
  level.push_back(std::move(picture));
  for (int k = 1; k <= levels; ++k) level.push_back(halved(level.back(), executor));
  const float share = 1 / static_cast<float>(levels);
  for (float& x : level.back().light) x *= share;
  for (std::size_t k = level.size() - 1; k > 0; --k) {
    add_doubled(level[k - 1], k > 1 ? share : 0.0f, level[k], executor);
    level.pop_back();
  }
  return std::move(level.front());
}

int bloom_levels(int height, double radius) {
  int levels = 1;
  while (levels < 16 && static_cast<double>(2 << levels) <= radius * height) ++levels;
  return levels;
}

std::uint64_t bloom_bytes(int width, int height) {
  std::uint64_t bytes = 0;
  for (int w = width, h = height; w > 1 || h > 1;) {
    w = (w + 1) / 2;
    h = (h + 1) / 2;
    bytes += 12 * static_cast<std::uint64_t>(w) * static_cast<std::uint64_t>(h);
  }
  return bytes;
}

}  // namespace rainref::simulation
