#include "puddle/rainfall.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "math/constants.h"
#include "rain/rain.h"
#include "rainref/error.h"
#include "random/draws.h"

namespace rainref::puddle {
namespace {

constexpr double energy_share = 0.01;                            // of the impact that goes into the wave; the rest splashes and stirs
constexpr double crater_per_diameter = 7;                        // crater radius over drop diameter
constexpr std::int32_t reflecting = 0, periodic = 1, fixed = 2;  // RainfallUniforms::boundary
constexpr double least_radius = 3;                               // texels; a smaller crater would not be resolved, so its energy is spread

/// A drop with its images beyond the edges, as Rainfall::drops says.
void add_with_images(const Drop& drop, const RainfallUniforms& u, std::vector<Drop>& out) {
  out.push_back(drop);
  if (u.boundary == fixed) return;
  // The place, and its image beyond the lower and the upper edge of a side; exact, because places have few bits.
  const auto images = [&](float at, std::uint32_t size) {
    const auto side = static_cast<float>(size);
    return u.boundary == periodic ? std::array{at, at - side, at + side} : std::array{at, -at, 2 * side - at};
  };
  const auto reaches = [&](float at, std::uint32_t size) { return at + drop.radius > 0 && at - drop.radius < static_cast<float>(size); };
  const auto xs = images(drop.x, u.columns), ys = images(drop.y, u.rows);
  for (std::size_t j = 0; j < ys.size(); ++j) {
    for (std::size_t i = 0; i < xs.size(); ++i) {
      if ((i > 0 || j > 0) && reaches(xs[i], u.columns) && reaches(ys[j], u.rows))
        out.push_back({xs[i], ys[j], drop.amplitude, drop.radius});
    }
  }
}

}  // namespace

double crater_depth(double diameter, double speed, double radius) {
  return __builtin_sqrt(energy_share * diameter * diameter * diameter * speed * speed * 35 / (18 * standard_gravity * radius * radius));
}

Rainfall::Rainfall(const Settings& s, double stored_per_metre)
    : seed_(s.seed), width_(static_cast<std::uint32_t>(s.grid[0])), height_(static_cast<std::uint32_t>(s.grid[1])), boundary_(s.boundary) {
  const rain::DropSizes sizes_of_rain(s.rain_rate, s.smallest_drop);
  const double area = s.grid[0] * s.cell_size * (s.grid[1] * s.cell_size);
  mean_ = sizes_of_rain.flux() * area / s.step_rate;
  count_ = random::PoissonTable(mean_);
  for (const double diameter_mm : sizes_of_rain.quantiles(sizes)) {
    const double diameter = diameter_mm * 1e-3;
    const double radius = std::max(crater_per_diameter * diameter, least_radius * s.cell_size);
    const double depth = crater_depth(diameter, rain::terminal_velocity(diameter_mm), radius);
    craters_.push_back({0, 0, static_cast<float>(-depth * s.drop_intensity * stored_per_metre), static_cast<float>(radius / s.cell_size)});
  }
}

std::vector<Drop> drops_of(const RainfallUniforms& u, std::span<const Drop> craters, std::span<const std::uint32_t> thresholds) {
  std::vector<Drop> out;
  if (craters.empty()) return out;
  constexpr std::int32_t most = 4 * static_cast<std::int32_t>(random::PoissonTable::max_mean);
  if (craters.size() != Rainfall::sizes || u.threshold_count < 0 || static_cast<std::size_t>(u.threshold_count) > thresholds.size() ||
      u.first_count < 0 || u.first_count > most || u.threshold_count > most) {
    throw Error(
        ExitCode::port_files,
        fmt::format(
            "raindrops: expected {} craters and at most {} thresholds, found {} craters, {} thresholds, first_count {}, threshold_count {}",
            int{Rainfall::sizes}, most, craters.size(), thresholds.size(), u.first_count, u.threshold_count));
  }
  const std::uint64_t seed = u.seed[0] | static_cast<std::uint64_t>(u.seed[1]) << 32;
  const auto used = thresholds.first(static_cast<std::size_t>(u.threshold_count));
  const random::Draws& draws = random::draws();
  const std::uint32_t word = draws.block(seed, random::Purpose::puddle_drop_count, u.step, 0)[0];
  const auto passed = static_cast<std::uint32_t>(std::upper_bound(used.begin(), used.end(), word) - used.begin());
  const auto count = u.first_count + static_cast<int>(draws.count(passed, static_cast<std::uint32_t>(used.size())));
  for (int i = 0; i < count; ++i) {
    const random::Block r = draws.block(seed, random::Purpose::puddle_drop, u.step, static_cast<std::uint32_t>(i));
    Drop drop = craters[draws.choice(r[2], 10)];
    drop.x = static_cast<float>(draws.fine((draws.place(r[0], 16) * u.columns) >> 8, 8, 0)) * 0x1p-8f;
    drop.y = static_cast<float>(draws.fine((draws.place(r[1], 16) * u.rows) >> 8, 8, 1)) * 0x1p-8f;
    add_with_images(drop, u, out);
  }
  return out;
}

std::vector<Drop> Rainfall::drops(std::int64_t step) const { return drops_of(uniforms(step), craters_, count_.thresholds()); }

RainfallUniforms Rainfall::uniforms(std::int64_t step) const {
  RainfallUniforms u{};
  u.seed[0] = static_cast<std::uint32_t>(seed_);
  u.seed[1] = static_cast<std::uint32_t>(seed_ >> 32);
  // Steps beyond 2^32 start over: at 240 steps a second after 207 days.
  u.step = static_cast<std::uint32_t>(step);
  u.first_count = count_.first();
  u.columns = width_;
  u.rows = height_;
  u.boundary = boundary_ == Boundary::reflecting ? reflecting : boundary_ == Boundary::periodic ? periodic : fixed;
  u.threshold_count = static_cast<std::int32_t>(count_.thresholds().size());
  return u;
}

}  // namespace rainref::puddle
