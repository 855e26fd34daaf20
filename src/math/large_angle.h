// Reduction of large angles by quarter turns in integers, by the method of Payne and Hanek.
#pragma once

#include <cstddef>

namespace rainref {

/// Angles up to this size are reduced in floating point (three parts of pi/2), larger ones in integers.
inline constexpr double largest_small_angle = 0x1p22;

/// An angle as turns * pi/2 + rest, |rest| <= pi/4 up to rounding. Full turns are dropped: turns is 0, 1, 2 or 3.
struct ReducedAngle {
  double turns, rest;
};

/// Reduces x with 2^22 <= x < 2^128. rest has a relative error of about 2^-52 for every float x. For a larger x, including infinity, the
/// result is that of some other angle.
ReducedAngle reduce_large_angle(double x);

/// The same for those of `count` angles that exceed largest_small_angle; the others keep their turns and rest.
void reduce_large_angles(const double* x, double* turns, double* rest, std::size_t count);

}  // namespace rainref
