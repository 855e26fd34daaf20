#include "windshield/motion/shelter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/number_text.h"
#include "rainref/error.h"
#include "scene/rows_of_text.h"

namespace rainref::windshield {
namespace {

constexpr std::size_t most_stretches = 64;
constexpr double farthest = 1e7;  // [m]
constexpr double endless = std::numeric_limits<double>::infinity();

/// The first time, from 0 on, when the car has driven this distance [s]; infinite if it does not within thirty years.
double time_at(const Vehicle& vehicle, double distance) {
  const auto is_there = [&](double t) { return vehicle.at(t).distance >= distance; };
  double before = 0, there = 1;
  if (is_there(before)) return 0;
  while (!is_there(there)) {
    before = there;
    there *= 2;
    if (there > 1e9) return endless;
  }
  for (;;) {  // the speed is never negative, so bisect to the last bit
    const double middle = before + 0.5 * (there - before);
    if (!(before < middle && middle < there)) return there;
    (is_there(middle) ? there : before) = middle;
  }
}

}  // namespace

std::vector<Stretch> parse_shelter(std::string_view text) {
  std::vector<Stretch> stretches;
  for (const std::string_view row : scene::split(text, ';')) {
    if (row.empty()) continue;
    const auto fail = [&] {
      throw Error(ExitCode::usage,
                  fmt::format("rain.shelter, stretch {}: expected \"from to\", ascending numbers of at most {:.0f} m, and at most {} "
                              "stretches; found '{}'",
                              stretches.size() + 1, farthest, most_stretches, row));
    };
    const std::vector<std::string_view> words = scene::words_of(row);
    if (words.size() != 2 || stretches.size() == most_stretches) fail();
    const Stretch s{number_from<double>(words[0]).value_or(2 * farthest), number_from<double>(words[1]).value_or(2 * farthest)};
    if (!(std::abs(s.from) <= farthest && std::abs(s.to) <= farthest && s.from < s.to)) fail();
    stretches.push_back(s);
  }
  std::sort(stretches.begin(), stretches.end(), [](const Stretch& a, const Stretch& b) { return a.from < b.from; });
  std::vector<Stretch> apart;
  for (const Stretch& s : stretches) {
    if (!apart.empty() && s.from <= apart.back().to)
      apart.back().to = std::max(apart.back().to, s.to);
    else
      apart.push_back(s);
  }
  return apart;
}

bool is_covered(const std::vector<Stretch>& roofs, double place) {
  return std::any_of(roofs.begin(), roofs.end(), [&](const Stretch& s) { return s.from <= place && place < s.to; });
}

Shelter::Shelter(const std::vector<Stretch>& roofs, const Vehicle& vehicle, double ahead) {
  for (const Stretch& s : roofs) {
    const Interval in{time_at(vehicle, s.from - ahead), time_at(vehicle, s.to - ahead)};
    if (in.from < in.to) covered_.push_back(in);
  }
}

double Shelter::open_share(double from, double to) const {
  double covered = 0;
  for (const Interval& in : covered_) covered += std::max(std::min(to, in.to) - std::max(from, in.from), 0.0);
  return 1 - covered / (to - from);
}

double Shelter::rained(const Weather& weather, double t) const {
  // A sum over the times in the open, so that it is exactly constant under a roof.
  double sum = 0, open_from = 0;
  for (const Interval& in : covered_) {
    if (!(open_from < t)) return sum;
    sum += weather.rained(std::min(t, in.from)) - weather.rained(open_from);
    open_from = in.to;
  }
  return open_from < t ? sum + (weather.rained(t) - weather.rained(open_from)) : sum;
}

}  // namespace rainref::windshield
