// Integer texel loads: the input, column, row and channel of each load of an invocation.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "faults/probe.h"
#include "rainref/texture.h"

namespace rainref::faults {

/// One load: the texel at offset (dx, dy), by its index in an invocation.
struct Tap {
  std::size_t load;
  int dx, dy, channel;
  bool is_extrapolated = false;  ///< twice the texel itself minus this one
  bool operator==(const Tap&) const = default;
};
struct Taps {
  std::string input;
  std::vector<Tap> all;
  int scale_x = 1, scale_y = 1;  ///< texels of the input for each texel of the pass: 2 if the output is half as large
  bool is_neighbour(const Tap& t) const { return t.dx != 0 || t.dy != 0; }
};

/// Finds the loads of input number `input` from texels that hold their own positions. None for records, mip levels, an input that is too
/// small, or if the pass rejects such texels.
Taps taps_of(const Probed& p, std::size_t input);

/// Column or row that an address rule maps i to; -1: outside.
int placed(int i, int size, Address address);

}  // namespace rainref::faults
