// Rain as meteorology measures it: from millimetres per hour to drops on a surface.
#pragma once

#include <vector>

namespace rainref::rain {

/// Terminal velocity [m/s] of a drop of this diameter [mm] in still air at sea level: table of R. Gunn and G. D. Kinzer (J. Meteor. 6,
/// 1949), linear between its entries, 0 at diameter 0, constant beyond 5.8 mm.
double terminal_velocity(double diameter_mm);

/// Drop-size distribution of J. S. Marshall and W. McK. Palmer (J. Meteor. 5, 1948):
/// N(D) = 8000 exp(-Lambda D) [1/m^3/mm], Lambda = 4.1 R^-0.21 [1/mm], R in mm/h. For R = 0 there are no drops. From 1 to 100 mm/h the
/// drops carry 3 to 19 % more water than the rate. This is a property of the model.
class DropSizes {
 public:
  static constexpr double largest_mm = 6.0;

  /// rate_mm_per_h in [0, 1000], smallest_mm in [0, largest_mm).
  DropSizes(double rate_mm_per_h, double smallest_mm);

  /// Drops of at least smallest_mm that hit a level surface [1/m^2/s].
  double flux() const { return flux_; }
  /// Lambda [1/mm].
  double lambda() const { return lambda_; }
  /// N(D), drops in the air by diameter [1/m^3/mm]; 0 without rain.
  double number(double diameter_mm) const;
  /// Drops in the air of at least this diameter [1/m^3].
  double in_air(double diameter_mm) const;
  /// Diameters [mm] at the quantiles (i + 1/2) / n of the arriving drops, increasing.
  std::vector<double> quantiles(int n) const;

 private:
  double rate_, smallest_, lambda_ = 0, flux_ = 0;
  double density(double diameter_mm) const;  // arrivals [1/m^2/s/mm]
};

}  // namespace rainref::rain
