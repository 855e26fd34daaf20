#include "faults/solver.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rainref::faults {
namespace {

using perturbed::Substitution;

void put_numbers(std::vector<Substitution>& places, const std::vector<double>& numbers) {
  for (std::size_t c = 0; c < places.size(); ++c) {
    places[c].back = 0;
    places[c].ahead = -1;
    places[c].number = static_cast<float>(numbers[c]);
    places[c].change = places[c].last = perturbed::Change::none;
    places[c].how = perturbed::Put::instead;
  }
}
double step_of(double x) { return 1e-3 * (std::abs(x) + 1e-2); }

/// Solves m x = b for at most three unknowns, by elimination with pivots; false if there is no solution.
bool solve(std::array<std::array<double, 3>, 3> m, std::array<double, 3> b, std::size_t n, std::array<double, 3>& x) {
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t r = k; r < n; ++r)
      if (std::abs(m[r][k]) > std::abs(m[pivot][k])) pivot = r;
    if (!(std::abs(m[pivot][k]) > 0)) return false;
    std::swap(m[k], m[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t r = k + 1; r < n; ++r) {
      const double f = m[r][k] / m[k][k];
      for (std::size_t c = k; c < n; ++c) m[r][c] -= f * m[k][c];
      b[r] -= f * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    x[k] = b[k];
    for (std::size_t c = k + 1; c < n; ++c) x[k] -= m[k][c] * x[c];
    x[k] /= m[k][k];
  }
  return std::all_of(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(n), [](double v) { return std::isfinite(v); });
}

}  // namespace

std::vector<float> Solver::values(const std::vector<Substitution>& places) const {
  perturbed::Substitutions all{places};
  all.start();
  perturbed::Behaviour b;
  b.known = &known_;
  b.substitutions = &all;
  const perturbed::Scope scope(b);
  all.look_ahead([&] { static_cast<void>(of_.evaluate()); });
  return of_.evaluate();
}
bool Solver::is_near(const std::vector<float>& v) const {
  if (v.size() != of_.port.size()) return false;
  for (std::size_t k = 0; k < v.size(); ++k)
    if (!(std::abs(static_cast<double>(v[k]) - of_.port[k]) <= of_.leeway[k])) return false;
  return true;
}
double Solver::misfit(const std::vector<float>& v) const {
  if (v.size() != of_.port.size()) return HUGE_VAL;
  double sum = 0;
  for (std::size_t k = 0; k < v.size(); ++k) {
    if (of_.leeway[k] == HUGE_VAL) continue;
    const double off = (static_cast<double>(v[k]) - of_.port[k]) / of_.leeway[k];
    sum += off * off;
  }
  return std::isnan(sum) ? HUGE_VAL : sum;
}

Solution Solver::with_slope(std::vector<Substitution>& places, const std::vector<double>& at) const {
  Solution s{at, {}, {}};
  put_numbers(places, at);
  s.values = values(places);
  s.slope.assign(s.values.size(), std::vector<double>(at.size(), 0.0));
  for (std::size_t c = 0; c < at.size(); ++c) {
    std::vector<double> beside = at;
    beside[c] += step_of(at[c]);
    put_numbers(places, beside);
    const std::vector<float> there = values(places);
    const double step = static_cast<double>(static_cast<float>(beside[c])) - static_cast<float>(at[c]);
    for (std::size_t k = 0; k < s.values.size() && k < there.size(); ++k)
      s.slope[k][c] = (static_cast<double>(there[k]) - s.values[k]) / step;
  }
  return s;
}

bool Solver::may_be(const Solution& s, const std::vector<float>& numbers) const {
  for (std::size_t k = 0; k < s.slope.size(); ++k) {
    if (of_.leeway[k] == HUGE_VAL) continue;
    double off = static_cast<double>(s.values[k]) - of_.port[k];
    for (std::size_t c = 0; c < numbers.size(); ++c) off += s.slope[k][c] * (static_cast<double>(numbers[c]) - s.at[c]);
    if (!(std::abs(off) <= 3 * of_.leeway[k])) return false;
  }
  return true;
}

std::vector<Solution> Solver::solutions(std::vector<Substitution> places, const std::vector<float>& now) const {
  put_numbers(places, {now.begin(), now.end()});
  const std::vector<float> right = values(places);
  if (right.size() != of_.port.size() || is_near(right)) return {};
  return places.size() == 1 ? of_one(std::move(places), now[0], right) : of_vector(std::move(places), now);
}

std::vector<Solution> Solver::of_one(std::vector<Substitution> places, float now, const std::vector<float>& right) const {
  const auto with = [&](float x) {
    put_numbers(places, {x});
    return values(places);
  };
  std::size_t slot = 0;
  double farthest = 0;
  for (std::size_t k = 0; k < right.size(); ++k)
    if (const double far = std::abs(static_cast<double>(right[k]) - of_.port[k]) / of_.leeway[k]; far > farthest) farthest = far, slot = k;
  const float size = now != 0 ? now : 1;
  const auto counts = [&](float x) {
    const std::vector<float> there = with(x);
    return there.size() == right.size() && there[slot] != right[slot];
  };
  const std::array<float, 6> apart{0.0f, 2 * size, -size, 0.5f * size, 1.1f * size, 20.0f};
  if (std::none_of(apart.begin(), apart.end(), counts)) return {};
  std::vector<float> tried{0, 0.01f, 0.1f, 0.5f, 1, 2, 5, 20, 100, 1000, -0.01f, -0.1f, -0.5f, -1, -2, -5, -20, -100, -1000};
  for (const float f : {-3.0f, -1.0f, -0.5f, 0.1f, 0.3f, 0.5f, 0.75f, 0.9f, 0.97f, 1.0f, 1.03f, 1.1f, 1.3f, 1.6f, 2.0f, 3.0f, 5.0f})
    tried.push_back(f * size);
  std::sort(tried.begin(), tried.end());
  tried.erase(std::unique(tried.begin(), tried.end()), tried.end());
  const auto off = [&](float x) {
    const std::vector<float> there = with(x);
    return there.size() == right.size() ? static_cast<double>(there[slot]) - of_.port[slot] : std::nan("");
  };
  std::vector<Solution> out;
  const auto keep = [&](float x) {
    if (x == now || !is_near(with(x))) return;
    out.push_back(with_slope(places, {x}));
  };
  double before = off(tried[0]);
  for (std::size_t k = 1; k < tried.size() && out.size() < 4; ++k) {
    const double at = off(tried[k]);
    if (std::isfinite(before) && std::isfinite(at) && (before < 0) != (at < 0)) keep(bisected(tried[k - 1], tried[k], before, 26, off));
    before = at;
  }
  return out;
}

/// Levenberg's method with a few starts: minimizes the sum of squares over the slots, each in units of its tolerance.
std::vector<Solution> Solver::of_vector(std::vector<Substitution> places, const std::vector<float>& now) const {
  const std::size_t n = places.size();
  for (const double scale : {1.0, 0.3, -1.0}) {
    std::vector<double> x;
    for (const float v : now) x.push_back(v == 0 && scale != 1 ? 0.3 * scale : v * scale);
    Solution s = with_slope(places, x);
    double best = misfit(s.values), damping = 1e-6;
    for (int round = 0; round < 14 && std::isfinite(best) && !is_near(s.values); ++round) {
      std::array<std::array<double, 3>, 3> m{};
      std::array<double, 3> b{}, step{};
      for (std::size_t k = 0; k < s.values.size(); ++k) {
        if (of_.leeway[k] == HUGE_VAL) continue;
        const double weight = 1 / of_.leeway[k];
        for (std::size_t r = 0; r < n; ++r) {
          b[r] += s.slope[k][r] * weight * (of_.port[k] - static_cast<double>(s.values[k])) * weight;
          for (std::size_t c = 0; c < n; ++c) m[r][c] += s.slope[k][r] * weight * s.slope[k][c] * weight;
        }
      }
      bool is_better = false;
      for (int times = 0; times < 6 && !is_better; ++times) {
        std::array<std::array<double, 3>, 3> damped = m;
        for (std::size_t r = 0; r < n; ++r) damped[r][r] += damping * m[r][r] + 1e-30;
        if (!solve(damped, b, n, step)) break;
        std::vector<double> next = x;
        for (std::size_t c = 0; c < n; ++c) next[c] += step[c];
        put_numbers(places, next);
        const double there = misfit(values(places));
        if (there < best) {
          is_better = true;
          x = next;
          best = there;
          damping = std::max(damping / 10, 1e-9);
        } else {
          damping = std::max(damping * 30, 1e-4);
        }
      }
      if (!is_better) break;
      s = with_slope(places, x);
    }
    if (is_near(s.values)) return {s};
  }
  return {};
}

}  // namespace rainref::faults
