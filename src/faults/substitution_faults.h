// A wrong variable: one operand that is another value of the invocation, or one with a term or factor too many.
#pragma once

#include <functional>
#include <vector>

#include "faults/place_faults.h"
#include "faults/probe.h"

namespace rainref::faults {

/// A failing texel, what a port stored there, and how far off that a number may be.
struct Solvable {
  const Probe& probe;
  std::vector<float> port;
  std::vector<double> leeway;
};
/// Adds what explains all of a few texels. An operand is first solved for: the number that it would need to have for what the port
/// stored, if any; then each value of the invocation is compared with it. `known`: as the probes were made with.
void add_solved_substitutions(std::vector<Fault>& out, const Probed& p, const std::vector<Solvable>& texels,
                              const std::vector<float>& known);

/// Adds the components of a vector taken for those of another, at each place of the probe where they stand; at most so many.
void add_vector_substitutions(std::vector<Fault>& out, const Probe& probe, const std::vector<float>& known, std::size_t most);

}  // namespace rainref::faults
