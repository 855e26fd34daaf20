// Functions of doubles made of operations that IEEE 754 rounds correctly, and of comparisons, without a library.
#pragma once

namespace rainref::compositor {

inline double root(double a) { return __builtin_sqrt(a); }
inline double magnitude(double a) { return a < 0 ? -a : a; }
inline double least(double a, double b) { return b < a ? b : a; }
inline double most(double a, double b) { return a < b ? b : a; }

}  // namespace rainref::compositor
