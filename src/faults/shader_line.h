// Finds the line of a port's shader that contains a mistake. There the port's values depart from the reference in the same way as the
// values of a mistake that reproduces the port's outputs.
#pragma once

#include <cstdint>
#include <vector>

#include "capture/traced_program.h"

namespace rainref::faults {

/// One invocation, traced three times.
struct Followed {
  perturbed::Trace right;      ///< the reference
  perturbed::Trace wrong;      ///< the reference with the mistake
  capture::ProgramTrace port;  ///< the port's program
  std::vector<int> outputs;    ///< the outputs' values that the mistake changes
};

/// A range of instructions of the program.
struct FoundLine {
  std::uint32_t at = 0;
  /// If a step is missing it has no line: the mistake is after `at` and not after this one. Otherwise equal to `at`.
  std::uint32_t until = 0;
  friend bool operator==(const FoundLine&, const FoundLine&) = default;
};

/// Places of a mistake in the program.
struct FoundLines {
  /// Best first: at most two, if the mistake's first value and the first value that the reference lacks are at different places.
  std::vector<FoundLine> lines;
  /// The function in which it is, and the call of this function: one of them is in `lines`.
  std::vector<FoundLine> function_and_call;
};
/// `in_function`: the mistake is in a function, whatever its caller. Values are equal if they agree within 1e-5 of their size in every
/// invocation, since another implementation sums in another order. Empty if no value of the program is the mistake's: its place is then
/// unknown.
FoundLines lines_of_mistake(const std::vector<Followed>& invocations, bool in_function = false);

/// Returns the places where the port departs from the reference, in order of execution: steps that the reference lacks although it has all
/// of their operands, and on which wrong outputs depend. Needs no mistake: `right` and `wrong` are equal. A step that also departs in
/// `passing` invocations only has another form, and comes last.
std::vector<FoundLine> departures(const std::vector<Followed>& failing, const std::vector<Followed>& passing);

}  // namespace rainref::faults
