#include "windshield/motion/pchip.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace rainref::windshield {
namespace {

// The slope at the outer end of the first of two intervals with steps h and chords c.
double end_slope(double h0, double h1, double c0, double c1) {
  const double slope = ((2 * h0 + h1) * c0 - h0 * c1) / (h0 + h1);
  if (slope * c0 <= 0) return 0;
  const double most = 3 * c0;
  return c0 * c1 < 0 && (slope / c0 > 3) ? most : slope;
}

}  // namespace

Pchip::Pchip(std::vector<double> x, std::vector<double> y) : x_(std::move(x)), y_(std::move(y)), slope_(x_.size()), sum_(x_.size()) {
  const std::size_t last = x_.size() - 1;
  std::vector<double> step(last), chord(last);
  for (std::size_t i = 0; i < last; ++i) {
    step[i] = x_[i + 1] - x_[i];
    chord[i] = (y_[i + 1] - y_[i]) / step[i];
  }
  for (std::size_t i = 1; i < last; ++i) {
    if (chord[i - 1] * chord[i] <= 0) continue;
    const double w0 = 2 * step[i] + step[i - 1], w1 = step[i] + 2 * step[i - 1];
    slope_[i] = (w0 + w1) / (w0 / chord[i - 1] + w1 / chord[i]);
  }
  if (last == 1) {
    slope_[0] = slope_[1] = chord[0];
  } else {
    slope_[0] = end_slope(step[0], step[1], chord[0], chord[1]);
    slope_[last] = end_slope(step[last - 1], step[last - 2], chord[last - 1], chord[last - 2]);
  }
  for (std::size_t i = 0; i < last; ++i) {
    sum_[i + 1] = sum_[i] + step[i] * (0.5 * (y_[i] + y_[i + 1]) + step[i] * (slope_[i] - slope_[i + 1]) / 12);
  }
}

Pchip::Place Pchip::place(double x) const {
  const auto after = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
  const std::size_t i = static_cast<std::size_t>(after - x_.begin()) - 1;
  return {i, x_[i + 1] - x_[i], x - x_[i]};
}

double Pchip::value(double x) const {
  if (x <= x_.front()) return y_.front();
  if (x >= x_.back()) return y_.back();
  const auto [i, h, s] = place(x);
  const double t = s / h, r = 1 - t;
  // Monotone in real arithmetic; the clamp keeps rounding from exceeding the ends, especially 0.
  const double hermite =
      y_[i] * (r * r * (1 + 2 * t)) + y_[i + 1] * (t * t * (3 - 2 * t)) + h * t * r * (slope_[i] * r - slope_[i + 1] * t);
  return std::clamp(hermite, std::min(y_[i], y_[i + 1]), std::max(y_[i], y_[i + 1]));
}

double Pchip::derivative(double x) const {
  if (x < x_.front() || x > x_.back()) return 0;
  const auto [i, h, s] = place(x);
  const double t = s / h, r = 1 - t;
  return 6 * t * r * ((y_[i + 1] - y_[i]) / h) + slope_[i] * r * (1 - 3 * t) + slope_[i + 1] * t * (3 * t - 2);
}

double Pchip::integral_to(double x) const {
  if (x <= x_.front()) return (x - x_.front()) * y_.front();
  if (x >= x_.back()) return sum_.back() + (x - x_.back()) * y_.back();
  const auto [i, h, s] = place(x);
  const double t = s / h, t2 = t * t, t3 = t2 * t, t4 = t2 * t2;
  return sum_[i] + h * (y_[i] * (t - t3 + 0.5 * t4) + y_[i + 1] * (t3 - 0.5 * t4) +
                        h * (slope_[i] * (0.5 * t2 - 2 * t3 / 3 + 0.25 * t4) + slope_[i + 1] * (0.25 * t4 - t3 / 3)));
}

}  // namespace rainref::windshield
