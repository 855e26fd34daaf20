// The rain in the air, for rays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compositor/tracer.h"
#include "rainref/windshield.h"

namespace rainref::truth {

using compositor::Vec;

/// Drops of a frame in a grid of cells. Thread-safe.
class FallingRainIndex {
 public:
  explicit FallingRainIndex(std::span<const windshield::FallingDropView> drops);

  /// Light that arrives along a ray (unit direction, car axes) with this radiance from `distance` metres away: each drop whose path during
  /// the exposure the ray meets covers it for a share of that time.
  Vec through(const Vec& origin, const Vec& direction, double distance, Vec radiance) const;

 private:
  struct Drop {
    Vec from, to;
    double radius, time_share;
    Vec radiance;
  };
  static double crossing(const Vec& origin, const Vec& direction, const Drop& d);
  struct Crossing {
    double t;
    std::uint32_t drop;
  };
  std::size_t cell(const int (&at)[3]) const {
    return (static_cast<std::size_t>(at[2]) * static_cast<std::size_t>(size_[1]) + static_cast<std::size_t>(at[1])) *
               static_cast<std::size_t>(size_[0]) +
           static_cast<std::size_t>(at[0]);
  }
  void cells_of(const Drop& drop, int (&low)[3], int (&high)[3]) const;

  std::vector<Drop> drops_;
  Vec low_{0, 0, 0};
  int size_[3] = {0, 0, 0};
  std::vector<std::uint32_t> first_, in_cell_;  // drops in_cell_[first_[c]] to in_cell_[first_[c + 1] - 1] overlap cell c
};

}  // namespace rainref::truth
