#include "puddle/bounds.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "capture/bound_texture.h"
#include "puddle/host.h"
#include "puddle/kernels.h"

namespace rainref::puddle {
namespace {

Extent larger(const Extent& a, const Extent& b) { return {std::max(a.height, b.height), std::max(a.difference, b.difference)}; }

struct Bound {
  float top, slope;
};
Bound bound(const Settings& s, const Extent& extent) {
  const double scale = encoding(s).scale;
  // A bilinear patch is no steeper than sqrt(2) of its largest difference; the sums keep a flat surface inside.
  return {static_cast<float>(extent.height * scale + 1e-4),
          static_cast<float>(extent.difference * scale / s.cell_size * 0x1.6a09e667f3bcdp+0 + 1e-3)};
}

}  // namespace

TextureData surface_bounds(const Settings& s, const float* decoded, const parallel::Executor& executor, SurfaceHitUniforms& u) {
  const auto [width, height] = wave_size(s);
  const int columns = (width + extent_block - 1) / extent_block, rows = (height + extent_block - 1) / extent_block;
  std::vector<Extent> blocks(static_cast<std::size_t>(columns) * rows);
  const float rest = encoding(s).rest;
  executor.for_tiles(width, height, width, extent_block, [&, w = width, h = height](const parallel::Tile& tile) {
    extents_of_rows(decoded, w, h, rest, tile, &blocks[static_cast<std::size_t>(tile.y0 / extent_block) * columns]);
  });

  std::vector<float> texels;
  texels.reserve(2 * blocks.size());
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      Extent around{0, 0};
      for (int v = std::max(0, y - 1); v <= std::min(rows - 1, y + 1); ++v) {
        for (int w = std::max(0, x - 1); w <= std::min(columns - 1, x + 1); ++w) {
          around = larger(around, blocks[static_cast<std::size_t>(v) * columns + w]);
        }
      }
      const Bound b = bound(s, around);
      texels.insert(texels.end(), {b.top, b.slope});
    }
  }
  Extent all{0, 0};
  for (const Extent& e : blocks) all = larger(all, e);
  const Bound b = bound(s, all);
  u.surface_top = b.top;
  u.surface_slope = b.slope;
  u.bounds_scale[0] = static_cast<float>(static_cast<double>(width) / (columns * extent_block));
  u.bounds_scale[1] = static_cast<float>(static_cast<double>(height) / (rows * extent_block));
  // Half a texel less than a block would suffice; the rest is for rounding.
  u.bounds_reach = static_cast<float>((extent_block - 1) * s.cell_size);
  return TextureData(texels, 2, columns, rows, Address::clamp, Address::clamp);
}

std::string doubt_bounds(const capture::PassCase& c) {
  if (!c.corrected()) return "";
  const capture::BoundTexture wave(capture::image_input(c, "wave"), 0, 1), bounds(capture::image_input(c, "bounds"));
  const Texture water = wave.view(), said = bounds.view();
  const auto u = capture::uniforms_of<SurfaceHitUniforms>(c);
  const int width = water.width[0], height = water.height[0];
  const int columns = (width + extent_block - 1) / extent_block, rows = (height + extent_block - 1) / extent_block;
  if (said.width[0] != columns || said.height[0] != rows)
    return fmt::format("in.bounds is {}x{}, a wave of {}x{} has {}x{} blocks", said.width[0], said.height[0], width, height, columns, rows);
  // Without the margins of surface_bounds, which cover the rounding of other implementations.
  const double to_slope = 2.0 * u.normal_gain * u.height_scale * 0x1.6a09e667f3bcdp+0;
  const float rest = -u.height_bias / u.height_scale;
  std::vector<Extent> blocks(static_cast<std::size_t>(columns));
  for (int y = 0; y < rows; ++y) {
    const parallel::Tile tile{0, y * extent_block, width, std::min(height, (y + 1) * extent_block)};
    extents_of_rows(water.texels, width, height, rest, tile, blocks.data());
    for (int x = 0; x < columns; ++x) {
      const Extent& e = blocks[static_cast<std::size_t>(x)];
      const double top = static_cast<double>(e.height) * u.height_scale, slope = e.difference * to_slope;
      const auto text = [&](const std::string& what, float said_top, float said_slope) {
        return fmt::format(
            "{} says height {:.6g} m and slope {:.6g}, the water in block ({}, {}) has {:.6g} m and {:.6g}: of another frame?", what,
            said_top, said_slope, x, y, top, slope);
      };
      if (top > u.surface_top || slope > u.surface_slope)
        return text("uniform surface_top or surface_slope", u.surface_top, u.surface_slope);
      for (int v = std::max(0, y - 1); v <= std::min(rows - 1, y + 1); ++v) {
        for (int w = std::max(0, x - 1); w <= std::min(columns - 1, x + 1); ++w) {
          const float* texel = said.texels + 2 * (static_cast<std::ptrdiff_t>(v) * columns + w);
          if (top > texel[0] || slope > texel[1]) return text(fmt::format("in.bounds at ({}, {})", w, v), texel[0], texel[1]);
        }
      }
    }
  }
  return "";
}

}  // namespace rainref::puddle
