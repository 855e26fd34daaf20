// A wrong variable: one operand that is another value of the invocation, or one with a term or factor too many.
#pragma once

#include <functional>
#include <vector>

#include "faults/place_faults.h"
#include "faults/probe.h"
#include "faults/solver.h"

namespace rainref::faults {

/// Adds what explains all of a few texels. An operand, a result or the components of a vector are first solved for: the numbers that
/// they would need to be for what the port stored, if any; then what can be made of the values of the invocation, of uniforms and of
/// small numbers is compared with them. `known`: as the probes were made with.
void add_solved_substitutions(std::vector<Fault>& out, const Probed& p, const std::vector<Solvable>& texels,
                              const std::vector<float>& known);

/// Adds the components of a vector taken for those of another, at each place of the probe where they stand; at most so many.
void add_vector_substitutions(std::vector<Fault>& out, const Probe& probe, const std::vector<float>& known, std::size_t most);

}  // namespace rainref::faults
