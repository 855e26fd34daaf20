#include "simulation/supersampling.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "image/colour.h"
#include "rainref/error.h"

namespace rainref::simulation {
namespace {

constexpr int tile_rows = 8;

/// Linear light of a code, and back: the nearest code. No libm, and the same bits for any order of pixels.
struct Curve {
  std::array<double, 256> light;
  std::array<double, 255> between;  ///< light of code k + 1/2

  Curve() {
    for (int k = 0; k < 256; ++k) light[static_cast<std::size_t>(k)] = decode_srgb(k / 255.0);
    for (int k = 0; k < 255; ++k) between[static_cast<std::size_t>(k)] = decode_srgb((k + 0.5) / 255.0);
  }
  std::uint8_t code(double x) const {
    return static_cast<std::uint8_t>(std::upper_bound(between.begin(), between.end(), x) - between.begin());
  }
};

/// Weights of the samples that a pixel takes along an axis, from `first` samples after its own first one on; their sum is 1.
struct Tent {
  int first;
  std::vector<double> weight;

  explicit Tent(int n) : first(-(n / 2)) {
    // Sample i lies (2 i + 1 - n) / 2n pixels from the centre of its pixel.
    double sum = 0;
    for (int i = first; i < n - first; ++i) {
      const int off = std::abs(2 * i + 1 - n);
      weight.push_back(off < 2 * n ? 2 * n - off : 0);
      sum += weight.back();
    }
    for (double& w : weight) w /= sum;
  }
};

}  // namespace

scene::Config config_at_pass_size(const scene::Config& config) {
  const std::int64_t n = config.integer("run.supersample");
  std::vector<scene::Config::Entry> entries = config.entries();
  for (scene::Config::Entry& e : entries) {
    if (e.parameter.key != "run.size") continue;
    scene::Integer2& size = std::get<scene::Integer2>(e.value);
    for (std::int64_t& side : size) {
      side *= n;
      if (static_cast<double>(side) > e.parameter.maximum)
        throw Error(ExitCode::usage, fmt::format("run.supersample: expected at most {:.0f} texels a side of run.size times it, found {}",
                                                 e.parameter.maximum, side));
    }
  }
  return scene::Config(std::move(entries), config.directory());
}

Image tent_mean(const Image& picture, int n, const parallel::Executor& executor) {
  static const Curve curve;
  const Tent tent(n);
  const int width = picture.width() / n, height = picture.height() / n, taps = static_cast<int>(tent.weight.size());
  Image out(Format::rgba8, width, height);
  executor.for_tiles(width, height, width, tile_rows, [&](const parallel::Tile& tile) {
    std::vector<double> column(static_cast<std::size_t>(picture.width()) * 3);  // one row of samples, weighed along y
    for (int y = tile.y0; y < tile.y1; ++y) {
      std::fill(column.begin(), column.end(), 0.0);
      for (int k = 0; k < taps; ++k) {
        const Unorm8* row = picture.row<Unorm8>(std::clamp(n * y + tent.first + k, 0, picture.height() - 1));
        const double w = tent.weight[static_cast<std::size_t>(k)];
        for (std::size_t x = 0; x < column.size() / 3; ++x)
          for (std::size_t c = 0; c < 3; ++c) column[3 * x + c] += w * curve.light[row[4 * x + c].code];
      }
      Unorm8* to = out.row<Unorm8>(y);
      for (int x = 0; x < width; ++x) {
        for (int c = 0; c < 3; ++c) {
          double sum = 0;
          for (int k = 0; k < taps; ++k) {
            const int at = std::clamp(n * x + tent.first + k, 0, picture.width() - 1);
            sum += tent.weight[static_cast<std::size_t>(k)] * column[static_cast<std::size_t>(3 * at + c)];
          }
          to[4 * x + c].code = curve.code(sum);
        }
        to[4 * x + 3].code = 255;
      }
    }
  });
  return out;
}

}  // namespace rainref::simulation
