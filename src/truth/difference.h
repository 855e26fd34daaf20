// Differences between passes (the trick) and traced light (the truth), pixel by pixel.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "rainref/image.h"

namespace rainref::truth {

/// Percentiles of absolute errors: the smallest value that at least this share of the pixels does not exceed.
struct Percentiles {
  double p50 = 0, p90 = 0, p99 = 0, max = 0;
  std::size_t count = 0;
};

/// A signed difference, trick minus truth, for every pixel of a picture where both are defined; NaN elsewhere.
class Difference {
 public:
  static constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

  /// `unit` is the unit of the values; name and unit become part of a file's name.
  Difference(std::string name, std::string unit, int width, int height)
      : name_(std::move(name)),
        unit_(std::move(unit)),
        width_(width),
        height_(height),
        values_(static_cast<std::size_t>(width) * height, undefined) {}

  const std::string& name() const { return name_; }
  const std::string& unit() const { return unit_; }
  /// Row 0 is the bottom.
  double& at(int x, int y) { return values_[static_cast<std::size_t>(y) * width_ + x]; }
  double at(int x, int y) const { return values_[static_cast<std::size_t>(y) * width_ + x]; }

  /// Of the absolute values of all defined pixels.
  Percentiles percentiles() const;
  /// Mean of the signed values: the bias of the trick.
  double mean() const;
  /// The 99th percentile, rounded up to 1, 2 or 5 times a power of ten: the difference shown in full colour.
  double scale() const;
  /// rgba8, row 0 = bottom: blue where the trick is lower than the truth, red where it is higher, white where they are
  /// equal, black where either is undefined; full colour from `scale` on. The bar at the bottom runs from -scale to +scale.
  Image picture() const;
  /// "NAME-SCALE-UNIT", such as "hit_distance-0.0005m": a file name that contains the picture's scale.
  std::string file_name() const;

 private:
  std::string name_, unit_;
  int width_, height_;
  std::vector<double> values_;
};

/// Differences between the passes and the rays of one picture: numbers of pixels by name, and pictures.
struct Comparison {
  std::vector<std::pair<std::string, std::size_t>> pixels;
  std::vector<Difference> differences;
};

}  // namespace rainref::truth
