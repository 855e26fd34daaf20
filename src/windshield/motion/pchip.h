// A smooth curve through points, without overshoot.
#pragma once

#include <vector>

namespace rainref::windshield {

/// A piecewise cubic with a continuous derivative, monotone wherever the points are: Fritsch and Butland's slopes (SIAM J. Sci. Stat.
/// Comput. 5, 1984), the weighted harmonic mean of the two neighbouring chords, 0 at an extremum; at the ends the parabola through three
/// points, limited to the sign of the chord and to three times it (Moler, Numerical Computing with MATLAB, ch. 3). Before the first and
/// after the last point the curve is constant.
class Pchip {
 public:
  Pchip() = default;
  /// x ascends strictly; y has the same size, at least two.
  Pchip(std::vector<double> x, std::vector<double> y);

  double value(double x) const;
  /// The exact derivative of value.
  double derivative(double x) const;
  /// The exact integral of value from a to b.
  double integral(double a, double b) const { return integral_to(b) - integral_to(a); }

 private:
  struct Place {
    std::size_t i;
    double step, from;  ///< length of the interval; distance from its left end
  };
  Place place(double x) const;
  double integral_to(double x) const;

  std::vector<double> x_, y_, slope_, sum_;
};

}  // namespace rainref::windshield
