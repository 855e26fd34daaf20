#include "effect/drops_layer.h"

#include <algorithm>
#include <utility>

#include "math/half.h"

namespace rainref::effect {

DropsLayer drops_layer(const Image& colour, Image background, const parallel::Executor& executor,
                       const std::function<DropPixel(int, int)>& pixel) {
  const int width = colour.width(), height = colour.height();
  DropsLayer layer{Image(Format::rgba16f, width, height), Image(Format::rg16f, width, height), std::move(background)};
  executor.for_tiles(width, height, width, 8, [&](const parallel::Tile& tile) {
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = 0; x < width; ++x) {
        const DropPixel p = pixel(x, y);
        const Half *seen = colour.row<Half>(y) + 4 * x, *behind = layer.background.row<Half>(y) + 4 * x;
        Half *drop = layer.drops.row<Half>(y) + 4 * x, *offset = layer.offset.row<Half>(y) + 2 * x;
        drop[3] = to_half(static_cast<float>(std::clamp(p.cover, 0.0, 1.0)), Rounding::rne);
        const double cover = to_float(drop[3]);  // the stored value, which the compositing engine reads
        for (int k = 0; k < 3; ++k)
          drop[k] = to_half(static_cast<float>(to_float(seen[k]) - (1 - cover) * to_float(behind[k])), Rounding::rne);
        if (!(cover > 0)) continue;
        offset[0] = to_half(static_cast<float>(p.u), Rounding::rne);
        offset[1] = to_half(static_cast<float>(p.v), Rounding::rne);
      }
    }
  });
  return layer;
}

}  // namespace rainref::effect
