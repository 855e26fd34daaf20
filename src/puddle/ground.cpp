#include "puddle/ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "cache/kept_images.h"
#include "puddle/scalar.h"
#include "random/counter.h"

namespace rainref::puddle {
namespace {

// Lattice value in [0, 1) of cell (x, y), layer n.
double lattice(std::uint64_t seed, int x, int y, std::uint32_t layer) {
  const random::Block b =
      random::block(seed, random::Purpose::puddle_bed, static_cast<std::uint32_t>(x) * 0x9e3779b9u + layer, static_cast<std::uint32_t>(y));
  return b[0] * 0x1p-32;
}
double ease(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

// One layer of value noise in [-1, 1]. It caches the corners of the last cell, because neighbouring texels mostly share a cell, and drawing
// corners is nearly all of the cost.
class Noise {
 public:
  Noise(std::uint64_t seed, std::uint32_t layer) : seed_(seed), layer_(layer) { meet(0, 0); }
  double operator()(double x, double y) {
    const double fx = std::floor(x), fy = std::floor(y), u = ease(x - fx), v = ease(y - fy);
    const int i = static_cast<int>(fx), j = static_cast<int>(fy);
    if (i != i_ || j != j_) meet(i, j);
    return 2 * ((a_ * (1 - u) + b_ * u) * (1 - v) + (c_ * (1 - u) + d_ * u) * v) - 1;
  }

 private:
  void meet(int i, int j) {
    i_ = i;
    j_ = j;
    a_ = lattice(seed_, i, j, layer_);
    b_ = lattice(seed_, i + 1, j, layer_);
    c_ = lattice(seed_, i, j + 1, layer_);
    d_ = lattice(seed_, i + 1, j + 1, layer_);
  }

  std::uint64_t seed_;
  std::uint32_t layer_;
  int i_ = 0, j_ = 0;
  double a_ = 0, b_ = 0, c_ = 0, d_ = 0;
};
double fractal(std::span<Noise> octaves, double x, double y) {
  double sum = 0, weight = 0.5;
  for (Noise& octave : octaves) {
    sum += weight * octave(x, y);
    x = 2 * x + 17.5;
    y = 2 * y + 3.25;
    weight /= 2;
  }
  return sum;
}

int bed_rows(const Settings& s) {
  const double half_x = 0.5 * s.grid[0] * s.cell_size, half_z = 0.5 * s.grid[1] * s.cell_size;
  return std::max(1, static_cast<int>(s.bed_columns * half_z / half_x));
}
/// The depths of a natural shape [m].
using DepthReads = cache::Only<&Settings::seed, &Settings::grid, &Settings::cell_size, &Settings::puddle_depth, &Settings::bed_columns>;
Image natural_bed(const int&, const DepthReads& reads) {
  const Settings& s = reads.of;
  const double half_x = 0.5 * s.grid[0] * s.cell_size, half_z = 0.5 * s.grid[1] * s.cell_size;
  const int width = s.bed_columns, height = bed_rows(s);
  Image depth(Format::r32f, width, height);
  std::array<Noise, 5> octaves{{{s.seed, 0}, {s.seed, 1}, {s.seed, 2}, {s.seed, 3}, {s.seed, 4}}};
  Noise grains(s.seed, 77);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double u = 2 * (x + 0.5) / width - 1, v = 2 * (y + 0.5) / height - 1;
      const double mx = u * half_x, mz = v * half_z;
      // A bowl that ends inside the rectangle, distorted by noise at the scale of a step, roughened by grain.
      const double bowl = 1.0 - 1.55 * (u * u + v * v) + 0.8 * fractal(octaves, 1.7 * mx + 40, 1.7 * mz + 40);
      const double window = 1 - std::max(u * u * u * u * u * u, v * v * v * v * v * v);
      const double grain = 0.0012 * grains(90 * mx, 90 * mz);
      const double shaped = s.puddle_depth * std::min(bowl, 3 * window - 1) + grain;
      depth.row<float>(y)[x] = static_cast<float>(std::min(shaped, s.puddle_depth));
    }
  }
  return depth;
}
constexpr int asphalt_texels = 512;  // a side
Image asphalt(const int&, const std::uint64_t& seed) {
  constexpr int size = asphalt_texels, cells = 80;
  Image tile(Format::rgba32f, size, size);
  // Stones: one jittered point in each cell; the tile wraps at its edges.
  std::vector<random::Block> stones;
  for (std::uint32_t y = 0; y < cells; ++y)
    for (std::uint32_t x = 0; x < cells; ++x) stones.push_back(random::block(seed, random::Purpose::puddle_ground, x, y));
  for (int y = 0; y < size; ++y) {
    float* row = tile.row<float>(y);
    for (int x = 0; x < size; ++x) {
      const double u = (x + 0.5) * cells / size, v = (y + 0.5) * cells / size;
      const int cx = static_cast<int>(u), cy = static_cast<int>(v);
      // The nearest two.
      double nearest = 4, second = 4;
      random::Block stone{};
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          const random::Block& b = stones[static_cast<std::size_t>((cy + j + cells) % cells * cells + (cx + i + cells) % cells)];
          const double dx = cx + i + b[0] * 0x1p-32 - u, dy = cy + j + b[1] * 0x1p-32 - v, d = dx * dx + dy * dy;
          if (d < nearest) {
            second = nearest;
            nearest = d;
            stone = b;
          } else {
            second = std::min(second, d);
          }
        }
      }
      const double edge = std::min(1.0, 3.0 * (std::sqrt(second) - std::sqrt(nearest)));  // 0 between two stones
      const double grey = stone[2] * 0x1p-32, warm = stone[3] * 0x1p-32;
      const double albedo = (0.035 + 0.11 * grey * grey) * (0.35 + 0.65 * edge);
      row[4 * x + 0] = static_cast<float>(albedo * (1.0 + 0.10 * warm));
      row[4 * x + 1] = static_cast<float>(albedo * (1.0 + 0.03 * warm));
      row[4 * x + 2] = static_cast<float>(albedo * (1.04 - 0.08 * warm));
      row[4 * x + 3] = static_cast<float>(edge * (0.4 + 0.6 * grey));
    }
  }
  return tile;
}

}  // namespace

TextureData make_bed(const Settings& s) {
  if (s.shape == Shape::basin) {
    TextureData bed({static_cast<float>(s.puddle_depth)}, 1, 1, 1, Address::border, Address::border);
    bed.set_border(static_cast<float>(s.puddle_depth), 0, 0, 0);
    return bed;
  }
  TextureData bed(cache::kept("puddle depths", cache::Shape{Format::r32f, s.bed_columns, bed_rows(s)}, rows_here, 0, natural_bed, s),
                  Address::border, Address::border);
  bed.set_border(static_cast<float>(-s.puddle_depth), 0, 0, 0);
  return bed;
}

Image make_asphalt(std::uint64_t seed) {
  return cache::kept("puddle asphalt", cache::Shape{Format::rgba32f, asphalt_texels, asphalt_texels}, rows_here, 0, asphalt, seed);
}

Image make_shore(const Settings& s, const Texture& bed) {
  Image shore(Format::r32f, s.grid[0], s.grid[1]);
  for (int y = 0; y < s.grid[1]; ++y) {
    for (int x = 0; x < s.grid[0]; ++x) {
      const scalar::Scalar<double> u((x + 0.5) / s.grid[0]), v((y + 0.5) / s.grid[1]);
      const double depth = scalar::sample_bilinear<0, 1>(bed, u, v)[0].v;
      const double t = std::clamp(depth / (2 * s.shore_width), 0.0, 1.0);
      shore.row<float>(y)[x] = static_cast<float>(t * t * (3 - 2 * t));
    }
  }
  return shore;
}

TextureData make_relief(const TextureData& ground, bool height_in_alpha, const Rows& rows) {
  constexpr float gain = 0.35f;  // slope of one unit of height between neighbouring texels
  const Texture& g = ground.view();
  const int w = g.width[0], h = g.height[0], c = g.channels;
  const auto height = [&](int x, int y) {
    const float* t = g.texels + (static_cast<std::size_t>((y + h) % h) * w + (x + w) % w) * c;
    return height_in_alpha ? t[3] : 0.2126f * t[0] + 0.7152f * t[1] + 0.0722f * t[2];
  };
  zeroed::Array<float> slopes(static_cast<std::size_t>(w) * h * 2);
  rows(h, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < w; ++x) {
        slopes[(static_cast<std::size_t>(y) * w + x) * 2] = gain * (height(x - 1, y) - height(x + 1, y));
        slopes[(static_cast<std::size_t>(y) * w + x) * 2 + 1] = gain * (height(x, y - 1) - height(x, y + 1));
      }
    }
  });
  TextureData relief(std::move(slopes), 2, w, h, Address::repeat, Address::repeat);
  relief.build_mips(Texture::max_levels, rows);
  return relief;
}

}  // namespace rainref::puddle
