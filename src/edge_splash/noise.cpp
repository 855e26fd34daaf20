// The noise map that needs no file: gradient noise (Ken Perlin, "Improving Noise", 2002: the fade 6 t^5 - 15 t^4 + 10 t^3)
// whose lattice repeats, in double.
#include <algorithm>
#include <cmath>
#include <vector>

#include "edge_splash/host.h"
#include "math/unorm.h"
#include "random/counter.h"

namespace rainref::edge_splash {
namespace {

constexpr double root = 0.7071067811865476;
constexpr double gradients[8][2] = {{1, 0}, {root, root}, {0, 1}, {-root, root}, {-1, 0}, {-root, -root}, {0, -1}, {root, -root}};

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
/// In [-1, 1] or so; period `cells` in both coordinates, at least 0.
class Octave {
 public:
  Octave(std::uint64_t seed, std::uint32_t layer, int cells) : cells_(cells) {
    gradients_.reserve(static_cast<std::size_t>(cells) * cells);
    for (std::uint32_t y = 0; y < static_cast<std::uint32_t>(cells); ++y)
      for (std::uint32_t x = 0; x < static_cast<std::uint32_t>(cells); ++x)
        gradients_.push_back(static_cast<std::uint8_t>(
            random::pcg4d({static_cast<std::uint32_t>(seed) ^ x, static_cast<std::uint32_t>(seed >> 32) ^ y, 0x73706c73u, layer})[0] >>
            29));
  }
  double operator()(double x, double y) const {
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const double fx = x - x0, fy = y - y0;
    double corner[2][2];
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < 2; ++i) {
        const double* g = gradients[gradients_[static_cast<std::size_t>((y0 + j) % cells_) * cells_ + (x0 + i) % cells_]];
        corner[j][i] = g[0] * (fx - i) + g[1] * (fy - j);
      }
    }
    const double u = fade(fx), v = fade(fy);
    const double low = corner[0][0] + u * (corner[0][1] - corner[0][0]), high = corner[1][0] + u * (corner[1][1] - corner[1][0]);
    return low + v * (high - low);
  }

 private:
  int cells_;
  std::vector<std::uint8_t> gradients_;  ///< of each lattice point
};

}  // namespace

Image make_noise(std::uint64_t seed, int side) {
  Image map(Format::r8, side, side);
  const int cells = std::max(1, side / 8);
  const Octave coarse(seed, 0, cells), fine(seed, 1, 2 * cells);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double px = (x + 0.5) / side, py = (y + 0.5) / side;
      const double n = coarse(px * cells, py * cells) + 0.5 * fine(px * 2 * cells, py * 2 * cells);
      map.row<Unorm8>(y)[x] = to_unorm8(static_cast<float>(0.5 + 0.62 * n));
    }
  }
  return map;
}

}  // namespace rainref::edge_splash
