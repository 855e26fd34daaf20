// What the reference gives for a case.
#pragma once

#include <vector>

#include "capture/pass_model.h"
#include "judge/verdict.h"
#include "rainref/executor.h"

namespace rainref::judge {

/// The reference's outputs for a case: what the pack should hold, or that with halves stored by another rounding. Keyed
/// records where the model knows them, in any order; what no model gives is as in the case.
std::vector<capture::Array> reference_outputs(const capture::PassCase& c, const capture::PassModel& model,
                                              const parallel::Executor& executor, HalfMode mode = HalfMode::either);

}  // namespace rainref::judge
