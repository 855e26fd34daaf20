// One mistake at one place of a pass text: a term left out, a sign, a factor twice, a lookup half a texel off.
#pragma once

#include <vector>

#include "faults/probe.h"

namespace rainref::faults {

/// Adds what can go wrong at each place that the probes met. `known`: as they were made with.
void add_place_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known);

/// Adds, for each constant, the value that it would need to have for what the port stored at some failing texels, where there
/// is one. `wanted`: texels and what the port stored there, one number for each slot.
struct Wanted {
  Texel at;
  std::vector<float> port, reference, step;  ///< step: to the next number that the slot can hold
};
void add_fitted_constants(std::vector<Fault>& out, const capture::PassModel& model, const Constants& constants,
                          const std::vector<Wanted>& wanted);

}  // namespace rainref::faults
