#include "compositor/picture.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "compositor/picture_kernels.h"
#include "math/half_array.h"
#include "rainref/error.h"

namespace rainref::compositor {
namespace {

constexpr int tile_width = 64, tile_height = 4;  // so that a tile's rays stay in the cache

/// Memory for a tile, kept by each thread for its next one.
struct Room {
  Columns<8> rays;
  SeenColumns seen;
  SampleSums sums;
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
    static thread_local Room room_of_thread;
    Room& room = room_of_thread;
    Columns<8>& rays = room.rays;
    rays.make_room(count);
    std::fill_n(rays[6], count, 0.0);
    std::fill_n(rays[7], count, std::numeric_limits<double>::infinity());
    room.sums.make_room(count);
    for (const Sample& sample : pattern) {
      std::size_t i = 0;
      const VecArraysOut origin = rays.vectors(0), direction = rays.vectors(3);
      for (int row = tile.y0; row < tile.y1; ++row) {
        for (int column = tile.x0; column < tile.x1; ++column, ++i) {
          const Ray ray = primary.through(column + 0.5 + sample.x, row + 0.5 + sample.y);
          origin.put(i, ray.origin);
          direction.put(i, ray.direction);
        }
      }
      shade(scene, options.shading, RayArrays{{rays[0], rays[1], rays[2]}, {rays[3], rays[4], rays[5]}, rays[6], rays[7]}, count,
            room.seen);
      add_sample(count, room.seen, &sample == pattern.data(), room.sums);
    }
    const double share = 1.0 / static_cast<double>(pattern.size());  // a power of two: exact
    for (int row = 0; row < rows; ++row) {
      // Converts the whole row to floats, then once for each image.
      float beauty[4 * tile_width], normal[4 * tile_width], film[tile_width], mask[tile_width], depth[tile_width];
      static_assert(tile_width % most_lanes == 0);
      const int y = tile.y0 + row;
      develop(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns), static_cast<std::size_t>(columns), share, room.sums,
              beauty, normal, film, mask, depth);
      std::copy_n(depth, columns, out.depth.row<float>(y) + tile.x0);
      const auto store = [&](const float* from, Image& image, int channels) {
        to_half_array(from, image.row<Half>(y) + channels * static_cast<std::ptrdiff_t>(tile.x0),
                      static_cast<std::size_t>(channels) * columns, Rounding::rne);
      };
      store(beauty, out.beauty, 4);
      store(normal, out.normal, 4);
      store(film, out.film, 1);
      store(mask, out.mask, 1);
    }
  });
  return out;
}

namespace {

// Sixteenths of a pixel from its centre. Source: Direct3D 11, D3D11_STANDARD_MULTISAMPLE_PATTERN; the Vulkan
// specification lists the same as its standard sample locations.
template <std::size_t n>
std::array<Sample, n> sixteenths(const int (&table)[n][2]) {
  std::array<Sample, n> out{};
  for (std::size_t i = 0; i < n; ++i) out[i] = {table[i][0] / 16.0, table[i][1] / 16.0};
  return out;
}
constexpr int one[][2] = {{0, 0}};
constexpr int four[][2] = {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
constexpr int eight[][2] = {{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};
constexpr int sixteen[][2] = {{1, 1},  {-1, -3}, {-3, 2},  {4, -1}, {-5, -2}, {2, 5},  {5, 3}, {3, -5},
                              {-2, 6}, {0, -7},  {-4, -6}, {-6, 4}, {-8, 0},  {7, -4}, {6, 7}, {-7, -8}};

}  // namespace

std::span<const Sample> samples(int count) {
  static const auto a = sixteenths(one);
  static const auto b = sixteenths(four);
  static const auto c = sixteenths(eight);
  static const auto d = sixteenths(sixteen);
  switch (count) {
    case 1:
      return a;
    case 4:
      return b;
    case 8:
      return c;
    case 16:
      return d;
    default:
      throw Error(ExitCode::usage, fmt::format("compositor.samples: expected 1, 4, 8 or 16, found {}", count));
  }
}

}  // namespace rainref::compositor
