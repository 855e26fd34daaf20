// Mistakes that need no search: how bytes lie, what a format keeps, when a buffer is written. Each gives a port's very values or does not.
// This is the one list of them.
#pragma once

#include <vector>

#include "faults/probe.h"

namespace rainref::faults {

/// Rows of another pitch, half a turn.
void add_layout_faults(std::vector<Fault>& out, const capture::PassCase& c, const std::vector<capture::Array>& port);
/// What another format or a blend makes of values: 10 and 11 bits, no subnormal halves, colours times their alpha.
void add_format_faults(std::vector<Fault>& out, const Probed& p, const std::vector<capture::Array>& port);
/// A buffer that is read while it is written: neighbours hold new values. And its two levels exchanged at the texel itself alone.
void add_in_place_faults(std::vector<Fault>& out, const Probed& p, const std::vector<capture::Array>& port);
/// A hash of fractions computed in half precision, at the texel `at` and all others.
void add_hash_faults(std::vector<Fault>& out, const Probed& p, Texel at);

/// All of them. What is given must outlive it: `port` holds what a port stored, in the order of the case's outputs.
inline std::vector<Fault> decidable_faults(const Probed& p, const std::vector<capture::Array>& port, Texel at) {
  std::vector<Fault> out;
  add_layout_faults(out, p.c, port);
  add_format_faults(out, p, port);
  add_in_place_faults(out, p, port);
  add_hash_faults(out, p, at);
  return out;
}

}  // namespace rainref::faults
