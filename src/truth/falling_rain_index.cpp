#include "truth/falling_rain_index.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace rainref::truth {
namespace {

constexpr double cell_size = 0.3;  // m

}  // namespace

/// t on the ray where a drop's path is nearest; negative if its distance exceeds the drop's radius.
double FallingRainIndex::crossing(const Vec& origin, const Vec& direction, const Drop& d) {
  const Vec way = d.to - d.from, away = origin - d.from;
  const double along = glm::dot(way, way), slant = glm::dot(direction, way), level = glm::dot(away, way);
  // The point of the path nearest to the line, clamped to the path's ends; then the ray's point nearest to that.
  const double across = along - slant * slant;
  const double s = across > 1e-15 ? std::clamp((level - slant * glm::dot(away, direction)) / across, 0.0, 1.0) : 0.5;
  const Vec at = d.from + s * way - origin;
  const double t = glm::dot(at, direction);
  const Vec off = at - t * direction;
  return glm::dot(off, off) < d.radius * d.radius ? t : -1;
}

void FallingRainIndex::cells_of(const Drop& d, int (&low)[3], int (&high)[3]) const {
  for (int k = 0; k < 3; ++k) {
    const auto index = [&](double x) { return std::clamp(static_cast<int>((x - low_[k]) / cell_size), 0, size_[k] - 1); };
    low[k] = index(std::min(d.from[k], d.to[k]) - d.radius);
    high[k] = index(std::max(d.from[k], d.to[k]) + d.radius);
  }
}

FallingRainIndex::FallingRainIndex(std::span<const windshield::FallingDropView> drops) {
  if (drops.empty()) return;
  const auto vec = [](const std::array<double, 3>& v) { return Vec(v[0], v[1], v[2]); };
  for (const windshield::FallingDropView& d : drops) drops_.push_back({vec(d.from), vec(d.to), d.radius, d.time_share, vec(d.radiance)});
  Vec high = low_ = drops_.front().from;
  for (const Drop& d : drops_) {
    low_ = glm::min(low_, glm::min(d.from, d.to) - d.radius);
    high = glm::max(high, glm::max(d.from, d.to) + d.radius);
  }
  for (int k = 0; k < 3; ++k) size_[k] = static_cast<int>((high[k] - low_[k]) / cell_size) + 1;
  const int above[3] = {size_[0], size_[1], size_[2]};
  first_.assign(static_cast<std::size_t>(above[0]) * static_cast<std::size_t>(above[1]) * static_cast<std::size_t>(above[2]) + 1, 0);
  const auto each = [&](const Drop& d, const auto& f) {
    int from[3], to[3];
    cells_of(d, from, to);
    for (int z = from[2]; z <= to[2]; ++z)
      for (int y = from[1]; y <= to[1]; ++y)
        for (int x = from[0]; x <= to[0]; ++x) f(cell({x, y, z}));
  };
  for (const Drop& d : drops_) each(d, [&](std::size_t c) { ++first_[c + 1]; });
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  in_cell_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < drops_.size(); ++i)
    each(drops_[i], [&](std::size_t c) { in_cell_[next[c]++] = static_cast<std::uint32_t>(i); });
}

Vec FallingRainIndex::through(const Vec& origin, const Vec& direction, double distance, Vec radiance) const {
  if (drops_.empty()) return radiance;
  // From the ray's entry into the grid to its exit.
  double enter = 0, leave = distance;
  for (int k = 0; k < 3; ++k) {
    const double from = low_[k], to = low_[k] + size_[k] * cell_size;
    if (direction[k] == 0) {
      if (origin[k] < from || origin[k] > to) return radiance;
      continue;
    }
    const double a = (from - origin[k]) / direction[k], b = (to - origin[k]) / direction[k];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (!(enter < leave)) return radiance;
  int at[3];
  double next[3], step[3];
  for (int k = 0; k < 3; ++k) {
    at[k] = std::clamp(static_cast<int>((origin[k] + enter * direction[k] - low_[k]) / cell_size), 0, size_[k] - 1);
    const double border = low_[k] + (direction[k] > 0 ? at[k] + 1 : at[k]) * cell_size;
    next[k] = direction[k] == 0 ? HUGE_VAL : (border - origin[k]) / direction[k];
    step[k] = direction[k] == 0 ? HUGE_VAL : cell_size / std::abs(direction[k]);
  }
  thread_local std::vector<Crossing> met;
  met.clear();
  for (double here = enter; here < leave;) {
    const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    const double there = std::min(next[axis], leave);
    const std::size_t c = cell(at);
    for (std::uint32_t i = first_[c]; i < first_[c + 1]; ++i) {
      // A drop that overlaps several cells counts in the cell where the ray meets it.
      const double t = crossing(origin, direction, drops_[in_cell_[i]]);
      if (t >= here && t < there) met.push_back({t, in_cell_[i]});
    }
    here = there;
    next[axis] += step[axis];
    at[axis] += direction[axis] > 0 ? 1 : -1;
    if (at[axis] < 0 || at[axis] >= size_[axis]) break;
  }
  std::sort(met.begin(), met.end(), [](const Crossing& a, const Crossing& b) { return a.t != b.t ? a.t > b.t : a.drop < b.drop; });
  for (const Crossing& m : met) {
    const Drop& d = drops_[m.drop];
    radiance += d.time_share * (d.radiance - radiance);
  }
  return radiance;
}

}  // namespace rainref::truth
