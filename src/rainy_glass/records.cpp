// Records of the bakes: droplets, rivulets and gradients, made from the seed by integers.
#include <algorithm>
#include <cmath>

#include "math/constants.h"
#include "math/real64.h"
#include "rainy_glass/host.h"
#include "random/counter.h"

namespace rainref::rainy_glass {
namespace {

constexpr double turn = 2 * pi;

double unit(std::uint32_t word) { return static_cast<double>(word >> 8) * 0x1p-24; }
/// A position in the tile with 16 bits.
float place(std::uint32_t word) { return static_cast<float>(word >> 16) * 0x1p-16f; }
/// Distance of two positions in a tile that wraps.
inline double apart(double a, double b) {
  const double d = std::abs(a - b);
  return std::min(d, 1 - d);
}
/// Distance from a to the interval [low, high] in a tile that wraps; the largest distance with `far`.
double apart(double a, double low, double high, bool far) {
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  double d = std::abs(a - middle);
  d = std::min(d, 1 - d);
  return far ? std::min(0.5, d + half) : std::max(0.0, d - half);
}

}  // namespace

std::vector<Droplet> make_droplets(const Settings& s) {
  // Radii with density ~ 1 / r^2: many small ones. The largest are placed first.
  std::vector<double> radii;
  for (int i = 0; i < s.droplet_count; ++i) {
    const double u = unit(random::block(s.seed, random::Purpose::glass_drop, static_cast<std::uint32_t>(i), 0)[0]);
    radii.push_back(s.smallest_droplet / (1 - u * (1 - s.smallest_droplet / s.largest_droplet)));
  }
  std::sort(radii.begin(), radii.end(), std::greater<>());
  const double gap = 2.0 / s.map_size;  // so that filtering does not mix two droplets
  std::vector<Droplet> out;
  for (int i = 0; i < s.droplet_count; ++i) {
    const auto radius = static_cast<float>(radii[static_cast<std::size_t>(i)]);
    for (std::uint32_t attempt = 1; attempt <= 48; ++attempt) {
      const random::Block b = random::block(s.seed, random::Purpose::glass_drop, static_cast<std::uint32_t>(i), attempt);
      const float x = place(b[0]), y = place(b[1]);
      const bool is_free = std::none_of(out.begin(), out.end(), [&](const Droplet& d) {
        const double reach = radius + d.radius + gap, dx = apart(x, d.x);
        if (dx >= reach) return false;  // true for nearly all of the millions of pairs
        const double dy = apart(y, d.y);
        return dx * dx + dy * dy < reach * reach;
      });
      if (!is_free) continue;
      // An ellipse: longest half axis `radius`, the other shorter by up to a quarter.
      const double squeeze = 1 + unit(b[2]) / 3;
      const Real64 angle(unit(b[3]) * turn);
      const double c = cos_real(angle).v, k = sin_real(angle).v;
      out.push_back({x, y, radius, static_cast<float>(radius / s.largest_droplet), static_cast<float>((c * c + squeeze * k * k) / radius),
                     static_cast<float>((1 - squeeze) * c * k / radius), static_cast<float>((k * k + squeeze * c * c) / radius),
                     random::uniform(random::block(s.seed, random::Purpose::glass_drop, static_cast<std::uint32_t>(i), 0)[1])});
      break;
    }
  }
  return out;
}

std::vector<Trail> make_trails(const Settings& s) {
  std::vector<Trail> out;
  for (int i = 0; i < s.trail_count; ++i) {
    const random::Block a = random::block(s.seed, random::Purpose::glass_trail, static_cast<std::uint32_t>(i), 0);
    const random::Block b = random::block(s.seed, random::Purpose::glass_trail, static_cast<std::uint32_t>(i), 1);
    // One in each column of the tile, so that they spread; thin ones are shallow.
    const auto column = static_cast<float>(static_cast<std::uint32_t>((i + unit(a[0])) * 65536 / s.trail_count)) * 0x1p-16f;
    const double size = 0.35 + 0.65 * unit(a[2]) * unit(a[2]), length = 0.12 + 0.6 * unit(a[3]) * size;
    const double wiggles = 2 + 5 * unit(b[0]);
    out.push_back({column, place(a[1]), static_cast<float>(size * s.trail_half_width), static_cast<float>(1 / length),
                   static_cast<float>(size), static_cast<float>(s.trail_half_width * 1.2 * unit(b[1])), static_cast<float>(wiggles),
                   static_cast<float>(unit(b[2]))});
  }
  return out;
}

Image make_lattice(const Settings& s) {
  const int side = 2 * s.flow_cells;
  Image lattice(Format::rgba32f, side, side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const random::Block b =
          random::block(s.seed, random::Purpose::glass_flow, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
      for (int k = 0; k < 2; ++k) {
        const Real64 angle(unit(b[k]) * turn);
        lattice.row<float>(y)[4 * x + 2 * k] = static_cast<float>(cos_real(angle).v);
        lattice.row<float>(y)[4 * x + 2 * k + 1] = static_cast<float>(sin_real(angle).v);
      }
    }
  }
  return lattice;
}

std::vector<Droplet> droplets_near(std::span<const Droplet> all, bool corrected, int size, int x0, int y0, int x1, int y1) {
  // From the first texel's centre to the last one's, widened for float rounding.
  const double margin = 1e-5;
  const double left = (x0 + 0.5) / size, right = (x1 - 0.5) / size, low = (y0 + 0.5) / size, high = (y1 - 0.5) / size;
  const auto measure = [&](const Droplet& d, bool far) {
    const double dx = apart(d.x, left, right, far), dy = apart(d.y, low, high, far);
    return dx * dx + dy * dy - (corrected ? static_cast<double>(d.radius) * d.radius : 0.0);
  };
  double least = 4;
  for (const Droplet& d : all) least = std::min(least, measure(d, true));
  std::vector<Droplet> out;
  for (const Droplet& d : all) {
    const double dx = apart(d.x, left, right, false), dy = apart(d.y, low, high, false), reach = d.radius + margin;
    if (measure(d, false) <= least + margin || dx * dx + dy * dy <= reach * reach) out.push_back(d);
  }
  return out;
}

std::vector<Trail> trails_near(std::span<const Trail> all, int size, int x0, int y0, int x1, int y1) {
  const double margin = 1e-5;
  const double left = (x0 + 0.5) / size, right = (x1 - 0.5) / size;
  std::vector<Trail> out;
  for (const Trail& t : all) {
    if (apart(t.x, left, right, false) > t.half_width + t.wiggle + margin) continue;
    for (int y = y0; y < y1; ++y) {
      double dy = (y + 0.5) / size - t.y + 0.125;
      dy = dy - std::floor(dy) - 0.125;
      // If rounding could wrap either way, the trail is kept.
      if ((dy >= -t.half_width - margin && dy * t.inverse_length <= 1 + margin) || dy < -0.125 + margin || dy > 0.875 - margin) {
        out.push_back(t);
        break;
      }
    }
  }
  return out;
}

}  // namespace rainref::rainy_glass
