#include "effect/drops_layer.h"

#include <algorithm>

#include "math/half.h"

namespace rainref::effect {

DropsLayer drops_layer(const Image& colour, const parallel::Executor& executor, const std::function<DropPixel(int, int)>& pixel) {
  const int width = colour.width(), height = colour.height();
  DropsLayer layer{Image(Format::rgba16f, width, height), Image(Format::rg16f, width, height)};
  executor.for_tiles(width, height, width, 8, [&](const parallel::Tile& tile) {
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = 0; x < width; ++x) {
        const DropPixel p = pixel(x, y);
        const double cover = std::clamp(p.cover, 0.0, 1.0);
        if (!(cover > 0)) continue;
        const Half* seen = colour.row<Half>(y) + 4 * x;
        Half *drop = layer.drops.row<Half>(y) + 4 * x, *offset = layer.offset.row<Half>(y) + 2 * x;
        for (int k = 0; k < 3; ++k) drop[k] = to_half(static_cast<float>(cover * to_float(seen[k])), Rounding::rne);
        drop[3] = to_half(static_cast<float>(cover), Rounding::rne);
        offset[0] = to_half(static_cast<float>(p.u), Rounding::rne);
        offset[1] = to_half(static_cast<float>(p.v), Rounding::rne);
      }
    }
  });
  return layer;
}

}  // namespace rainref::effect
