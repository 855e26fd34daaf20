#include "simulation/light_mean.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "image/colour.h"
#include "rainref/error.h"

namespace rainref::simulation {
namespace {

struct Curve {
  std::array<double, 256> light;
  std::array<double, 255> between;  ///< light of code k + 1/2

  Curve() {
    for (int k = 0; k < 256; ++k) light[static_cast<std::size_t>(k)] = decode_srgb(k / 255.0);
    for (int k = 0; k < 255; ++k) between[static_cast<std::size_t>(k)] = decode_srgb((k + 0.5) / 255.0);
  }
};
const Curve& curve() {
  static const Curve made;
  return made;
}

/// Weights of a pixel's samples along an axis, from `first` samples after its own first one on; their sum is 1.
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

double light_of(std::uint8_t code) { return curve().light[code]; }

std::uint8_t nearest_code(double light) {
  const auto& between = curve().between;
  return static_cast<std::uint8_t>(std::upper_bound(between.begin(), between.end(), light) - between.begin());
}

std::uint8_t dithered_code(double light, double u) {
  const auto& of = curve().light;
  const auto above = std::upper_bound(of.begin(), of.end(), light);
  if (above == of.begin()) return 0;
  if (above == of.end()) return 255;
  const auto below = above - 1;
  const auto code = static_cast<std::uint8_t>(below - of.begin());
  return u * (*above - *below) < light - *below ? static_cast<std::uint8_t>(code + 1) : code;
}

Image picture_of_means(int width, int height, int n, const RowOfLight& row_of, const CodesOf& codes_of,
                       const parallel::Executor& executor) {
  const Tent tent(n);
  const int taps = static_cast<int>(tent.weight.size());
  Image out(Format::rgba8, width, height);
  executor.for_tiles(width, height, width, tile_rows, [&](const parallel::Tile& tile) {
    std::vector<double> samples(3 * static_cast<std::size_t>(n) * static_cast<std::size_t>(width)), column(samples.size());
    for (int y = tile.y0; y < tile.y1; ++y) {
      std::fill(column.begin(), column.end(), 0.0);
      for (int k = 0; k < taps; ++k) {
        const double w = tent.weight[static_cast<std::size_t>(k)];
        if (w == 0) continue;
        row_of(std::clamp(n * y + tent.first + k, 0, n * height - 1), samples);
        for (std::size_t i = 0; i < column.size(); ++i) column[i] += w * samples[i];
      }
      Unorm8* to = out.row<Unorm8>(y);
      for (int x = 0; x < width; ++x) {
        std::array<double, 3> sum{};
        for (int k = 0; k < taps; ++k) {
          const auto at = static_cast<std::size_t>(3 * std::clamp(n * x + tent.first + k, 0, n * width - 1));
          for (std::size_t c = 0; c < 3; ++c) sum[c] += tent.weight[static_cast<std::size_t>(k)] * column[at + c];
        }
        std::array<std::uint8_t, 3> codes;
        codes_of(x, y, sum.data(), codes.data());
        for (int c = 0; c < 3; ++c) to[4 * x + c].code = codes[static_cast<std::size_t>(c)];
        to[4 * x + 3].code = 255;
      }
    }
  });
  return out;
}

scene::Config config_at_pass_size(const scene::Config& config) {
  const std::int64_t n = config.integer("run.supersample");
  const scene::Config::Entry& e = config.entry("run.size");
  scene::Integer2 size = config.integer2("run.size");
  for (std::int64_t& side : size) {
    side *= n;
    if (static_cast<double>(side) > e.parameter.maximum)
      throw Error(ExitCode::usage, fmt::format("run.supersample: expected at most {:.0f} texels a side of run.size times it, found {}",
                                               e.parameter.maximum, side));
  }
  scene::Config larger = config;
  larger.set("run.size", size, e.origin);
  return larger;
}

Image tent_mean(const Image& picture, int n, const parallel::Executor& executor) {
  const auto row_of = [&](int y, std::span<double> light) {
    const Unorm8* row = picture.row<Unorm8>(y);
    for (std::size_t x = 0; x < light.size() / 3; ++x)
      for (std::size_t c = 0; c < 3; ++c) light[3 * x + c] = light_of(row[4 * x + c].code);
  };
  const auto codes_of = [](int, int, const double* light, std::uint8_t* codes) {
    for (int c = 0; c < 3; ++c) codes[c] = nearest_code(light[c]);
  };
  return picture_of_means(picture.width() / n, picture.height() / n, n, row_of, codes_of, executor);
}

}  // namespace rainref::simulation
