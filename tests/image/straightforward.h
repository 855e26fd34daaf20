// Texture lookups as a textbook writes them: in double, address rules on texel indices. Shares nothing with the source.
#pragma once

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "image/texture.h"

namespace rainref::test {

/// The texel index of an address rule, or -1 for the border.
inline int addressed(Address address, long long i, int size) {
  const long long period = address == Address::mirror ? 2LL * size : size;
  const long long m = ((i % period) + period) % period;
  switch (address) {
    case Address::clamp:
      return static_cast<int>(i < 0 ? 0 : i >= size ? size - 1 : i);
    case Address::repeat:
      return static_cast<int>(m);
    case Address::mirror:
      return static_cast<int>(m < size ? m : period - 1 - m);
    case Address::border:
      return i < 0 || i >= size ? -1 : static_cast<int>(i);
  }
  return -1;
}
inline double texel_at(const Texture& t, int level, long long x, long long y, int c) {
  const int i = addressed(t.address_u, x, t.width[level]), j = addressed(t.address_v, y, t.height[level]);
  if (i < 0 || j < 0) return t.border[c];
  return t.texels[(static_cast<std::size_t>(t.offset[level]) + static_cast<std::size_t>(j) * t.width[level] + i) * t.channels + c];
}
inline double nearest_at(const Texture& t, double u, double v, int c) {
  return texel_at(t, 0, static_cast<long long>(std::floor(u * t.width[0])), static_cast<long long>(std::floor(v * t.height[0])), c);
}
inline double bilinear_at(const Texture& t, int level, double u, double v, int c) {
  const double x = u * t.width[level] - 0.5, y = v * t.height[level] - 0.5;
  const auto i = static_cast<long long>(std::floor(x)), j = static_cast<long long>(std::floor(y));
  const double fx = x - static_cast<double>(i), fy = y - static_cast<double>(j);
  return (1 - fy) * ((1 - fx) * texel_at(t, level, i, j, c) + fx * texel_at(t, level, i + 1, j, c)) +
         fy * ((1 - fx) * texel_at(t, level, i, j + 1, c) + fx * texel_at(t, level, i + 1, j + 1, c));
}
inline double trilinear_at(const Texture& t, double u, double v, double lod, int c) {
  const double l = std::clamp(lod, 0.0, t.levels - 1.0);
  const int fine = static_cast<int>(l), coarse = std::min(fine + 1, t.levels - 1);
  return (1 - (l - fine)) * bilinear_at(t, fine, u, v, c) + (l - fine) * bilinear_at(t, coarse, u, v, c);
}

constexpr double pi = 3.14159265358979323846;

inline double latlong_at(const Texture& t, const std::array<double, 3>& d, double lod, int c) {
  const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  return trilinear_at(t, 0.5 + std::atan2(d[2], d[0]) / (2 * pi), 0.5 + std::asin(d[1] / length) / pi, lod, c);
}
/// Faces above each other in one image; s and t of the direction by the table that graphics APIs share.
inline double cube_at(const Texture& texture, const std::array<double, 3>& d, double lod, int c) {
  int axis = 0;
  for (int k = 1; k < 3; ++k) axis = std::fabs(d[k]) > std::fabs(d[axis]) ? k : axis;
  const bool negative = d[axis] < 0;
  const double x = d[0], y = d[1], z = d[2], major = std::fabs(d[axis]);
  const double table[6][2] = {{-z, -y}, {z, -y}, {x, z}, {x, -z}, {x, -y}, {-x, -y}};
  const int face = 2 * axis + negative;
  const int level = static_cast<int>(std::floor(std::clamp(lod, 0.0, texture.levels - 1.0) + 0.5)), side = texture.width[level];
  const auto inside = [&](double s) { return std::clamp((s / major + 1) / 2 * side - 0.5, 0.0, side - 1.0); };
  const double sx = inside(table[face][0]), sy = inside(table[face][1]);
  const int i = static_cast<int>(sx), j = static_cast<int>(sy), i1 = std::min(i + 1, side - 1), j1 = std::min(j + 1, side - 1);
  const double fx = sx - i, fy = sy - j;
  const auto texel = [&](int column, int row) { return texel_at(texture, level, column, face * side + row, c); };
  return (1 - fy) * ((1 - fx) * texel(i, j) + fx * texel(i1, j)) + fy * ((1 - fx) * texel(i, j1) + fx * texel(i1, j1));
}

/// A texture of noise in [0, 1) with all its mip levels.
inline TextureData noise_texture(int width, int height, int channels, Address u, Address v, std::uint32_t seed = 1) {
  std::mt19937 random(seed);  // its words are fixed by the C++ standard
  std::vector<float> texels(static_cast<std::size_t>(width) * height * channels);
  for (float& x : texels) x = static_cast<float>(random() >> 8) * 0x1p-24f;
  TextureData t(std::move(texels), channels, width, height, u, v);
  t.set_border(0.25f, -3.0f, 5.0f, 7.0f);
  t.build_mips();
  return t;
}

}  // namespace rainref::test
