// Texels loaded by integers: which input, column, row and channel each load of an invocation reads.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "faults/probe.h"
#include "rainref/texture.h"

namespace rainref::faults {

/// One load: of the texel (dx, dy) away, by its number in an invocation.
struct Tap {
  std::size_t load;
  int dx, dy, channel;
  bool is_extrapolated = false;  ///< twice the texel itself less this one
  bool operator==(const Tap&) const = default;
};
struct Taps {
  std::string input;
  std::vector<Tap> all;
  int scale_x = 1, scale_y = 1;  ///< texels of the input for each of the pass: 2 where it is half as large
  bool is_neighbour(const Tap& t) const { return t.dx != 0 || t.dy != 0; }
};

/// The loads of input number `input`, found by giving it texels that say where they lie; none of records, of mip levels, of an input that
/// is too small, or where the pass refuses such texels.
Taps taps_of(const Probed& p, std::size_t input);

/// Where a texel of a row or column stands by an address rule; -1: nowhere.
int placed(int i, int size, Address address);

}  // namespace rainref::faults
