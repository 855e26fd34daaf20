// A noise map without a file: gradient noise (Ken Perlin, "Improving Noise", 2002: the fade 6 t^5 - 15 t^4 + 10 t^3) with a repeating
// lattice, in double.
#include <algorithm>

#include <cmath>
#include <vector>

#include "edge_splash/host.h"
#include "math/unorm.h"
#include "random/counter.h"

namespace rainref::edge_splash {
namespace {

constexpr double diagonal = 0.7071067811865476;
constexpr double gradients[8][2] = {{1, 0},  {diagonal, diagonal},   {0, 1},  {-diagonal, diagonal},
                                    {-1, 0}, {-diagonal, -diagonal}, {0, -1}, {diagonal, -diagonal}};

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
/// In about [-1, 1]; period `cells` in both coordinates, at least 0.
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

namespace {

constexpr int slots = 1200;            // drops at the same time
constexpr double life = 0.25;          // of a crown [s]
constexpr double largest = 8.0 / 512;  // radius of a grown crown [tile sides]
constexpr int jets = 7;

double share(std::uint32_t word) { return word * 0x1p-32; }
double mixed(double a, double b, double t) { return a + (b - a) * t; }

/// A jet or a droplet: a capsule from (ax, ay) to (bx, by) [texel] with radii ra and rb at its ends; the larger value is kept.
struct Capsule {
  double ax, ay, bx, by, ra, rb, value;

  void draw(Image& map) const {
    const int side = map.width();
    const double widest = std::max(ra, rb) + 1, dx = bx - ax, dy = by - ay, inverse = 1 / std::max(dx * dx + dy * dy, 1e-9);
    const auto first = [&](double a, double b) { return static_cast<int>(std::floor(std::min(a, b) - widest)); };
    const auto last = [&](double a, double b) { return static_cast<int>(std::floor(std::max(a, b) + widest)); };
    for (int y = first(ay, by); y <= last(ay, by); ++y) {
      float* row = map.row<float>((y % side + side) % side);
      for (int x = first(ax, bx); x <= last(ax, bx); ++x) {
        const double px = x + 0.5 - ax, py = y + 0.5 - ay, t = std::clamp((px * dx + py * dy) * inverse, 0.0, 1.0);
        const double ox = px - t * dx, oy = py - t * dy, inside = mixed(ra, rb, t) - std::sqrt(ox * ox + oy * oy);
        const float v = static_cast<float>(value * std::clamp(inside + 0.5, 0.0, 1.0));  // the edge is a texel wide
        float& texel = row[(x % side + side) % side];
        texel = std::max(texel, v);
      }
    }
  }
};

}  // namespace

Image make_crowns(std::uint64_t seed, double time, int side) {
  Image map(Format::r32f, side, side);
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    // Drops of a slot follow one another; slots are staggered over the life of a crown.
    const double turn = time / life + static_cast<double>(slot) / slots, whole = std::floor(turn), age = turn - whole;
    const random::Block b = random::block(seed, random::Purpose::splash_crown, slot, static_cast<std::uint32_t>(whole));
    const double x = share(b[0]) * side, y = share(b[1]) * side, size = mixed(0.6, 1.0, share(b[2])) * largest * side;
    const double radius = size * mixed(0.45, 1.0, age), height = 6 * size * age * (1 - age), thin = 1 - age * age;
    const double width = std::max(0.8, 0.13 * size);
    const random::Block jitter = random::block(seed, random::Purpose::splash_crown, slot + slots, static_cast<std::uint32_t>(whole));
    for (int j = 0; j < jets; ++j) {
      const double draw = share(jitter[static_cast<std::size_t>(j) % 4] << 8 * (j / 4));
      const double aside = 2 * (j + mixed(0.3, 0.7, draw)) / jets - 1;  // -1 and 1: the crown's outline, where the view is along the wall
      const double h = height * (0.7 + 0.4 * draw), tip_x = x + 1.15 * aside * radius, tip_y = y + h;
      Capsule{x + 0.75 * aside * radius, y, tip_x, tip_y, width, 0.5 * width, thin * (0.45 + 0.35 * aside * aside)}.draw(map);
      if (draw > 0.4) Capsule{tip_x, tip_y + 1.5 * width, tip_x, tip_y + 1.5 * width, 0.75 * width, 0.75 * width, thin}.draw(map);
    }
  }
  return map;
}

}  // namespace rainref::edge_splash
