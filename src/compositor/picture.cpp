#include "compositor/picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/half_array.h"

namespace rainref::compositor {
namespace {

constexpr int tile_width = 64, tile_height = 4;  // a tile's rays stay in the cache

/// Sums over the samples of a pixel.
struct Sum {
  Vec radiance{0, 0, 0}, normal{0, 0, 0};
  double film = 0, mask = 0, met = 0, depth = far;
};

}  // namespace

PrimaryRays::PrimaryRays(const scene::Camera& camera, int width, int height) {
  const scene::Camera::Basis basis = camera.basis();
  const double half_height = camera.half_height(), pixel = 2 * half_height / height;
  position_ = camera.position;
  corner_ = basis.forward - (half_height * width / height) * basis.right - half_height * basis.up;
  across_ = pixel * basis.right;
  up_ = pixel * basis.up;
}

Picture trace_picture(const Scene& scene, const scene::Camera& camera, int width, int height, const PictureOptions& options,
                      const parallel::Executor& executor) {
  const std::span<const Sample> pattern = samples(options.samples);
  const PrimaryRays primary(camera, width, height);
  Picture out{Image(Format::rgba16f, width, height), Image(Format::rgba16f, width, height), Image(Format::r32f, width, height),
              Image(Format::r16f, width, height), Image(Format::r16f, width, height)};
  executor.for_tiles(width, height, tile_width, tile_height, [&](const parallel::Tile& tile) {
    const int columns = tile.x1 - tile.x0, rows = tile.y1 - tile.y0;
    const std::size_t count = static_cast<std::size_t>(columns) * rows;
    // Kept by each thread for its next tile.
    static thread_local std::vector<Ray> rays;
    static thread_local std::vector<Seen> seen;
    static thread_local std::vector<Sum> sums;
    rays.resize(count);
    seen.resize(count);
    sums.assign(count, Sum{});
    for (const Sample& sample : pattern) {
      Ray* ray = rays.data();
      for (int row = tile.y0; row < tile.y1; ++row) {
        for (int column = tile.x0; column < tile.x1; ++column) *ray++ = primary.through(column + 0.5 + sample.x, row + 0.5 + sample.y);
      }
      shade(scene, options.shading, rays, seen);
      for (std::size_t i = 0; i < count; ++i) {
        Sum& sum = sums[i];
        const Seen& s = seen[i];
        sum.radiance += s.radiance;
        sum.normal += s.normal;
        sum.film += s.film;
        sum.mask += s.is_masked;
        if (!s.hit.is_surface()) continue;
        sum.met += 1;
        sum.depth = std::min(sum.depth, s.hit.t);
      }
    }
    const double share = 1.0 / static_cast<double>(pattern.size());  // a power of two: exact
    for (int row = 0; row < rows; ++row) {
      // All floats of the row, then one conversion for each image.
      float beauty[4 * tile_width], normal[4 * tile_width], film[tile_width], mask[tile_width];
      const int y = tile.y0 + row;
      for (int x = 0; x < columns; ++x) {
        const Sum& sum = sums[static_cast<std::size_t>(row) * columns + x];
        for (int k = 0; k < 3; ++k) {
          beauty[4 * x + k] = static_cast<float>(std::min(share * sum.radiance[k], 65504.0)) + 0.0f;
          normal[4 * x + k] = static_cast<float>(share * sum.normal[k]) + 0.0f;
        }
        beauty[4 * x + 3] = 1;
        normal[4 * x + 3] = static_cast<float>(share * sum.met);
        film[x] = static_cast<float>(share * sum.film);
        mask[x] = static_cast<float>(share * sum.mask);
        out.depth.row<float>(y)[tile.x0 + x] = static_cast<float>(sum.depth);
      }
      const auto store = [&](const float* from, Image& image, int channels) {
        to_half_array(from, image.row<Half>(y) + channels * static_cast<std::ptrdiff_t>(tile.x0), static_cast<std::size_t>(channels) * columns, Rounding::rne);
      };
      store(beauty, out.beauty, 4);
      store(normal, out.normal, 4);
      store(film, out.film, 1);
      store(mask, out.mask, 1);
    }
  });
  return out;
}

}  // namespace rainref::compositor
