// Finds the drops that may touch, for the passes whose records depend on their neighbours.
#include <algorithm>
#include <cmath>
#include <map>

#include "drops/info.h"

namespace rainref::drops {

Surroundings::Surroundings(const float (&frame)[3], const Drop& drop, double base) {
  const double u = drop.position[0], v = drop.position[1], x_of_u = frame[0] * u, x_of_v = frame[1] * v;
  x = x_of_u + x_of_v;
  y = frame[2] * v;
  // A radius is a power, accurate to 2^-14 at worst; a position is a sum of two products, each accurate to a few roundings of its size.
  radius = 1.01 * base + 0x1p-18 * (std::abs(x_of_u) + std::abs(x_of_v) + std::abs(y));
}
bool Surroundings::meets(const Surroundings& other) const {
  const double dx = x - other.x, dy = y - other.y, reach = radius + other.radius;
  return dx * dx + dy * dy < reach * reach;
}

std::vector<std::pair<std::size_t, std::size_t>> meeting_ones(const std::vector<Surroundings>& all) {
  double side = 0;
  for (const Surroundings& s : all) side = std::max(side, 2.001 * s.radius);  // a little wider, for rounding
  if (side == 0) return {};                                                   // points meet nothing
  // Circles that meet lie in one cell or in neighbouring cells. A radius grows with the coordinates, so cell numbers stay small.
  using Cell = std::pair<int, int>;
  const auto cell_of = [&](const Surroundings& s) {
    return Cell(static_cast<int>(std::floor(s.y / side)), static_cast<int>(std::floor(s.x / side)));
  };
  std::map<Cell, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < all.size(); ++i) cells[cell_of(all[i])].push_back(i);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto [row, column] = cell_of(all[i]);
    const std::size_t first = pairs.size();
    for (int k = 0; k < 9; ++k) {
      const auto cell = cells.find({row + k / 3 - 1, column + k % 3 - 1});
      if (cell == cells.end()) continue;
      for (const std::size_t other : cell->second)
        if (other > i && all[i].meets(all[other])) pairs.emplace_back(i, other);
    }
    std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(first), pairs.end());
  }
  return pairs;
}

}  // namespace rainref::drops
