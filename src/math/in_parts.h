// Enclosures of a function that uses two arguments often: evaluated over parts of them, because each use alone would cover the whole range.
#pragma once

#include "math/enclosure.h"

namespace rainref::enclosed {

/// f(x, y) over the cells of a grid that covers both intervals. A device's x and y lie in one cell, so the hull of f over all cells holds
/// its result for any f. f should decide nothing, because a decision is repeated in each cell.
template <class F>
scalar::Vec3<Enclosure> in_parts(Enclosure x, Enclosure y, const F& f) {
  constexpr int most = 16;
  constexpr double fine = 0x1p-10;  // narrower intervals are not divided
  if (x.is_vacuous() || y.is_vacuous()) return f(x, y);
  x = x.unrounded();
  y = y.unrounded();
  const auto count = [](Enclosure a) {
    const double parts = (static_cast<double>(a.hi) - a.lo) / fine;
    return parts < 1 ? 1 : parts < most ? static_cast<int>(parts) : most;
  };
  const auto part = [](Enclosure a, int k, int of) {
    const double width = (static_cast<double>(a.hi) - a.lo) / of;
    const auto edge = [&](int i) { return i == 0 ? a.lo : i == of ? a.hi : static_cast<float>(a.lo + i * width); };
    return Enclosure(edge(k), edge(k + 1));
  };
  const int columns = count(x), rows = count(y);
  scalar::Vec3<Enclosure> all = f(part(x, 0, columns), part(y, 0, rows));
  for (int k = 1; k < columns * rows; ++k) {
    const scalar::Vec3<Enclosure> one = f(part(x, k % columns, columns), part(y, k / columns, rows));
    all = scalar::Vec3<Enclosure>(hull(all.x, one.x), hull(all.y, one.y), hull(all.z, one.z));
  }
  return all;
}

}  // namespace rainref::enclosed
