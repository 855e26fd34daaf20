#include "compositor/picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/half.h"

namespace rainref::compositor {
namespace {

constexpr int tile_width = 64, tile_height = 16;

Half half_of(double x) { return to_half(static_cast<float>(x) + 0.0f); }

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
    std::vector<Ray> rays(count);
    std::vector<Seen> seen(count);
    std::vector<Sum> sums(count);
    for (const Sample& sample : pattern) {
      for (std::size_t i = 0; i < count; ++i) {
        const double x = tile.x0 + static_cast<int>(i) % columns + 0.5 + sample.x, y = tile.y0 + static_cast<int>(i) / columns + 0.5 + sample.y;
        rays[i] = primary.through(x, y);
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
    for (std::size_t i = 0; i < count; ++i) {
      const int x = tile.x0 + static_cast<int>(i) % columns, y = tile.y0 + static_cast<int>(i) / columns;
      const Sum& sum = sums[i];
      Half* beauty = out.beauty.row<Half>(y) + 4 * static_cast<std::ptrdiff_t>(x);
      Half* normal = out.normal.row<Half>(y) + 4 * static_cast<std::ptrdiff_t>(x);
      for (int k = 0; k < 3; ++k) {
        beauty[k] = half_of(std::min(share * sum.radiance[k], 65504.0));
        normal[k] = half_of(share * sum.normal[k]);
      }
      beauty[3] = half_of(1);
      normal[3] = half_of(share * sum.met);
      out.depth.row<float>(y)[x] = static_cast<float>(sum.depth);
      out.film.row<Half>(y)[x] = half_of(share * sum.film);
      out.mask.row<Half>(y)[x] = half_of(share * sum.mask);
    }
  });
  return out;
}

}  // namespace rainref::compositor
