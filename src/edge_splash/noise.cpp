// The noise map that needs no file: gradient noise (Ken Perlin, "Improving Noise", 2002: the fade 6 t^5 - 15 t^4 + 10 t^3)
// whose lattice repeats, in double.
#include <algorithm>
#include <cmath>

#include "edge_splash/host.h"
#include "math/unorm.h"
#include "random/counter.h"

namespace rainref::edge_splash {
namespace {

constexpr double root = 0.7071067811865476;
constexpr double gradients[8][2] = {{1, 0}, {root, root}, {0, 1}, {-root, root}, {-1, 0}, {-root, -root}, {0, -1}, {root, -root}};

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
/// In [-1, 1] or so; period `cells` in both coordinates.
double octave(std::uint64_t seed, std::uint32_t layer, int cells, double x, double y) {
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const double fx = x - x0, fy = y - y0;
  double corner[2][2];
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const auto cx = static_cast<std::uint32_t>((x0 + i) % cells), cy = static_cast<std::uint32_t>((y0 + j) % cells);
      const random::Block word = random::pcg4d({static_cast<std::uint32_t>(seed) ^ cx, static_cast<std::uint32_t>(seed >> 32) ^ cy, 0x73706c73u, layer});
      const double* g = gradients[word[0] >> 29];
      corner[j][i] = g[0] * (fx - i) + g[1] * (fy - j);
    }
  }
  const double u = fade(fx), v = fade(fy);
  const double low = corner[0][0] + u * (corner[0][1] - corner[0][0]), high = corner[1][0] + u * (corner[1][1] - corner[1][0]);
  return low + v * (high - low);
}

}  // namespace

Image make_noise(std::uint64_t seed, int side) {
  Image map(Format::r8, side, side);
  const int cells = std::max(1, side / 8);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double px = (x + 0.5) / side, py = (y + 0.5) / side;
      const double n = octave(seed, 0, cells, px * cells, py * cells) + 0.5 * octave(seed, 1, 2 * cells, px * 2 * cells, py * 2 * cells);
      map.row<Unorm8>(y)[x] = to_unorm8(static_cast<float>(0.5 + 0.62 * n));
    }
  }
  return map;
}

}  // namespace rainref::edge_splash
