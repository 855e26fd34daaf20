#include "truth/difference.h"

#include <algorithm>

#include <fmt/format.h>

namespace rainref::truth {
namespace {

std::uint8_t code(double share) { return static_cast<std::uint8_t>(255 * std::clamp(share, 0.0, 1.0) + 0.5); }

/// White at 0, red at 1, blue at -1.
void colour(double signed_share, Unorm8* texel) {
  const double s = std::clamp(signed_share, -1.0, 1.0), pale = 1 - std::abs(s);
  texel[0].code = s >= 0 ? code(1 - 0.25 * s) : code(pale);
  texel[1].code = code(pale);
  texel[2].code = s <= 0 ? code(1 + 0.25 * s) : code(pale);
  texel[3].code = 255;
}

}  // namespace

Percentiles Difference::percentiles() const {
  std::vector<double> errors;
  for (const double v : values_) {
    if (!std::isnan(v)) errors.push_back(std::abs(v));
  }
  Percentiles out;
  out.count = errors.size();
  if (errors.empty()) return out;
  std::sort(errors.begin(), errors.end());
  const auto at_share = [&](std::size_t hundredths) { return errors[(hundredths * errors.size() + 99) / 100 - 1]; };
  out.p50 = at_share(50);
  out.p90 = at_share(90);
  out.p99 = at_share(99);
  out.max = errors.back();
  return out;
}

double Difference::mean() const {
  double sum = 0;
  std::size_t count = 0;
  for (const double v : values_) {
    if (std::isnan(v)) continue;
    sum += v;
    ++count;
  }
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

double Difference::scale() const {
  const double wanted = percentiles().p99;
  if (!(wanted > 0)) return 1;
  // Positive powers of ten are exact, negative ones rounded once.
  for (int decade = -12; decade < 12; ++decade) {
    double power = 1;
    for (int i = 0; i < std::abs(decade); ++i) power *= 10;
    for (const double step : {1.0, 2.0, 5.0}) {
      const double s = decade < 0 ? step / power : step * power;
      if (s >= wanted) return s;
    }
  }
  return wanted;
}

Image Difference::picture() const {
  Image out(Format::rgba8, width_, height_);
  const double full = scale();
  const int bar = std::max(1, height_ / 40);
  for (int y = 0; y < height_; ++y) {
    Unorm8* row = out.row<Unorm8>(y);
    for (int x = 0; x < width_; ++x) {
      if (y < bar) {
        colour(2 * (x + 0.5) / width_ - 1, row + 4 * x);
      } else if (std::isnan(at(x, y))) {
        row[4 * x + 3].code = 255;
      } else {
        colour(at(x, y) / full, row + 4 * x);
      }
    }
  }
  return out;
}

std::string Difference::file_name() const { return fmt::format("{}-{:g}{}", name_, scale(), unit_); }

}  // namespace rainref::truth
