#include "judge/rearrange.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "rainref/image.h"

namespace rainref::judge {

using capture::Array;

namespace {

/// Copies to texel (x, y) of a level the texel at from(x, y).
template <class From>
void rearrange(Array& a, From from, int level = 0) {
  const capture::Bytes old = a.levels[static_cast<std::size_t>(level)];
  std::vector<std::byte> texels(old.size());
  const int width = a.level_width(level), height = a.level_height(level);
  const auto offset = [&](int x, int y) {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * a.element_bytes();
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto [u, v] = from(x, y);
      std::memcpy(texels.data() + offset(x, y), old.data() + offset(u, v), a.element_bytes());
    }
  }
  a.levels[static_cast<std::size_t>(level)] = std::move(texels);
}
}  // namespace

void flip_rows(Array& a) {
  for (int l = 0; l < static_cast<int>(a.levels.size()); ++l)
    rearrange(
        a, [&](int x, int y) { return std::pair(x, a.level_height(l) - 1 - y); }, l);
}
void flip_columns(Array& a) {
  for (int l = 0; l < static_cast<int>(a.levels.size()); ++l)
    rearrange(
        a, [&](int x, int y) { return std::pair(a.level_width(l) - 1 - x, y); }, l);
}
void shift(Array& a, int dx, int dy) {
  rearrange(a, [&](int x, int y) { return std::pair(std::clamp(x + dx, 0, a.width - 1), std::clamp(y + dy, 0, a.height - 1)); });
}
void transpose(Array& a) {
  const int side = std::min(a.width, a.height);
  rearrange(a, [side](int x, int y) { return x < side && y < side ? std::pair(y, x) : std::pair(x, y); });
}
void swap_channels(Array& a, int first, int second) {
  const int n = info(a.format).channel_bytes;
  each_texel(a, [=](std::byte* t) { std::swap_ranges(t + first * n, t + (first + 1) * n, t + second * n); });
}
void copy_channel(Array& a, int from, int to) {
  const int n = info(a.format).channel_bytes;
  each_texel(a, [=](std::byte* t) { std::copy(t + from * n, t + (from + 1) * n, t + to * n); });
}

}  // namespace rainref::judge
