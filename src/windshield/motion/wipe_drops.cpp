#include "windshield/motion/kernels.h"

#include <algorithm>
#include <array>
#include <vector>

#include "windshield/motion/extent_between.h"

namespace rainref::windshield {
namespace {

constexpr std::int64_t drops_to_a_chunk = 1024;
constexpr int rows_to_a_tile = 4;
constexpr auto largest_mass = static_cast<std::uint64_t>(drops::most_mass);

/// Result of a chunk of drops: those captured by a blade, and the mass units that left the glass.
struct Met {
  struct Riding {
    std::size_t slot, bin;  ///< bin: index among all records' bins
  };
  std::vector<Riding> riding;
  std::uint64_t removed = 0;
};

// The ends of the previous and the current blade, widened by half_width and by the sagitta of the arc; in texels of the film.
struct SweptArea {
  std::array<Corner, 4> corners;
  std::array<double, 2> margin;
};
SweptArea swept_area(const Wiper& w, const WipeDropsUniforms& u) {
  const double cosine = static_cast<double>(w.previous_axis[0]) * w.axis[0] + static_cast<double>(w.previous_axis[1]) * w.axis[1];
  const double bulge = w.outer_radius * (1 - __builtin_sqrt(std::max(0.0, 0.5 * (1 + cosine))));
  const double margin = w.half_width + bulge;
  const auto magnitude = [](double x) { return x < 0 ? -x : x; };
  const double reach[2] = {margin * (magnitude(u.inverse_frame[0]) + magnitude(u.inverse_frame[1])),
                           margin * magnitude(u.inverse_frame[2])};
  SweptArea area{};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double texel = u.texel[axis];
    const double at[4] = {w.previous_inner[axis], w.previous_outer[axis], w.inner[axis], w.outer[axis]};
    for (std::size_t k = 0; k < 4; ++k) area.corners[k][axis] = at[k] / texel;
    area.margin[axis] = reach[axis] / texel + 2;  // two texels more for rounding
  }
  return area;
}

struct Range {
  int begin, end;
};
Range range_of(double low, double high, int size) {
  // NaN maps to before the first texel.
  const auto whole = [&](double x) { return x > -1 ? static_cast<int>(std::min(x, size + 1.0)) : -1; };
  return {std::clamp(whole(low) - 1, 0, size), std::clamp(whole(high) + 1, 0, size)};
}

/// Columns outside which nothing of the row is swept.
Range columns_of(const SweptArea& area, int row, int width) {
  const auto [first, last] = extent_between(area.corners, row - area.margin[1], row + 1 + area.margin[1]);
  return first > last ? Range{0, 0} : range_of(first - area.margin[0], last + area.margin[0], width);
}

// Mass units removed from the film, by record and bin. Integers, so their sum does not depend on the tiles' order.
std::vector<std::uint64_t> sweep_film(const WipeDropsUniforms& u, std::span<const Wiper> wipers, Image& film,
                                      const parallel::Executor& executor) {
  std::vector<SweptArea> areas;
  for (const Wiper& w : wipers)
    if (w.direction != 0) areas.push_back(swept_area(w, u));
  const std::size_t bins = wipers.size() * static_cast<std::size_t>(u.bin_count);
  std::vector<std::vector<std::uint64_t>> by_tile(static_cast<std::size_t>((film.height() + rows_to_a_tile - 1) / rows_to_a_tile));
  executor.for_tiles(film.width(), film.height(), film.width(), rows_to_a_tile, [&](const parallel::Tile& tile) {
    std::vector<std::uint64_t>& taken = by_tile[static_cast<std::size_t>(tile.y0 / rows_to_a_tile)];
    std::vector<Range> ranges;
    for (int y = tile.y0; y < tile.y1; ++y) {
      ranges.clear();
      for (const SweptArea& area : areas) ranges.push_back(columns_of(area, y, film.width()));
      std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) { return a.begin < b.begin; });
      int done = 0;
      for (const Range& r : ranges) {
        const int begin = std::max(r.begin, done);
        if (begin >= r.end) continue;
        taken.resize(bins);
        wipe_film_row(u, wipers.data(), film, y, begin, r.end, taken.data());
        done = r.end;
      }
    }
  });
  std::vector<std::uint64_t> mass_units(bins);
  for (const std::vector<std::uint64_t>& tile : by_tile) {
    for (std::size_t k = 0; k < tile.size(); ++k) mass_units[k] += tile[k];
  }
  return mass_units;
}

}  // namespace

TexelBox swept_texels(const Wiper& w, const WipeDropsUniforms& u) {
  if (w.direction == 0) return {0, 0, 0, 0};
  const SweptArea area = swept_area(w, u);
  const auto range = [&](std::size_t axis, int size) {
    const auto [low, high] = std::minmax({area.corners[0][axis], area.corners[1][axis], area.corners[2][axis], area.corners[3][axis]});
    return range_of(low - area.margin[axis], high + area.margin[axis], size);
  };
  const Range x = range(0, u.columns), y = range(1, u.rows);
  return {x.begin, y.begin, x.end, y.end};
}

std::uint64_t wipe_drops(const WipeDropsUniforms& u, bool corrected, std::span<const Wiper> wipers, const DropSpans& drops, Image* film,
                         const parallel::Executor& executor) {
  const auto slots = static_cast<std::int64_t>(drops.u.size());
  pass::HostIo<WipeDropsPass> io;
  io.drops.columns = {drops.u.data(),          drops.v.data(),    drops.velocity_u.data(),
                      drops.velocity_v.data(), drops.mass.data(), drops.life.data()};
  io.wipers = wipers;
  std::vector<Met> of_chunk(static_cast<std::size_t>((slots + drops_to_a_chunk - 1) / drops_to_a_chunk));
  executor.for_range(slots, drops_to_a_chunk, [&](std::int64_t begin, std::int64_t end) {
    if (!corrected) return wipe_drops_range(u, corrected, io, nullptr, nullptr, begin, end);
    std::array<float, drops_to_a_chunk> wiper, bin;
    wiper.fill(-1.0f);
    wipe_drops_range(u, corrected, io, wiper.data(), bin.data(), begin, end);
    Met& met = of_chunk[static_cast<std::size_t>(begin / drops_to_a_chunk)];
    for (std::int64_t i = begin; i < end; ++i) {
      const float by = wiper[static_cast<std::size_t>(i - begin)];
      if (by == -2) met.removed += static_cast<std::uint64_t>(drops.mass[static_cast<std::size_t>(i)]);
      if (by < 0) continue;
      const auto in_bin = static_cast<std::size_t>(bin[static_cast<std::size_t>(i - begin)]);
      met.riding.push_back({static_cast<std::size_t>(i), static_cast<std::size_t>(by) * static_cast<std::size_t>(u.bin_count) + in_bin});
    }
  });
  if (!corrected) return 0;

  std::vector<std::uint64_t> mass_units = sweep_film(u, wipers, *film, executor);
  // The drop with the lowest id for each record and bin.
  std::vector<std::int64_t> taker(mass_units.size(), -1);
  std::uint64_t removed = 0;
  for (const Met& met : of_chunk) {
    removed += met.removed;
    for (const Met::Riding& r : met.riding) {
      std::int64_t& best = taker[r.bin];
      if (best < 0 || drops.id[r.slot] < drops.id[static_cast<std::size_t>(best)]) best = static_cast<std::int64_t>(r.slot);
    }
  }
  for (std::size_t k = 0; k < mass_units.size(); ++k) {
    if (taker[k] >= 0) {
      float& mass = drops.mass[static_cast<std::size_t>(taker[k])];
      const std::uint64_t have = static_cast<std::uint64_t>(mass),
                          gained = std::min(mass_units[k], largest_mass - std::min(have, largest_mass));
      mass = static_cast<float>(have + gained);
      mass_units[k] -= gained;
    }
    removed += mass_units[k];
  }
  return removed;
}

}  // namespace rainref::windshield
