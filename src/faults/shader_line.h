// The line of a port's shader that a mistake stands in: where what the port computes leaves the reference as a mistake leaves it, which
// gives what the port stored.
#pragma once

#include <cstdint>
#include <vector>

#include "capture/traced_program.h"

namespace rainref::faults {

/// One invocation, followed three times.
struct Followed {
  perturbed::Trace right;      ///< the reference
  perturbed::Trace wrong;      ///< the reference with the mistake
  capture::ProgramTrace port;  ///< the port's program
  std::vector<int> outputs;    ///< which values of the outputs the mistake changes
};

/// Instructions of the program.
struct FoundLine {
  std::uint32_t at = 0;
  /// Where a step is missing there is no line of it: the mistake lies after `at` and not after this one. Else the same as `at`.
  std::uint32_t until = 0;
  friend bool operator==(const FoundLine&, const FoundLine&) = default;
};

/// Where a mistake stands in the program, best first: at most two, where the first value of the mistake and the first that the reference
/// has not are others. `in_function`: it is made where a function is, whoever calls it. Values count as the same within 1e-5 of their size
/// in every invocation, since another hand sums in another order. Empty where no value of the program is the mistake's: then it is no place
/// in the program that is known.
std::vector<FoundLine> lines_of_mistake(const std::vector<Followed>& invocations, bool in_function = false);

}  // namespace rainref::faults
