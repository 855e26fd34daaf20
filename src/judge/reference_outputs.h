// Computes the reference's outputs of a case.
#pragma once

#include <vector>

#include "capture/pass_model.h"
#include "judge/verdict.h"
#include "rainref/executor.h"

namespace rainref::judge {

/// The expected outputs, or the same with halves stored by another rounding. Keyed records are in any order if the model computes them;
/// outputs without a model are copied from the case.
std::vector<capture::Array> reference_outputs(const capture::PassCase& c, const capture::PassModel& model,
                                              const parallel::Executor& executor, HalfMode mode = HalfMode::either);

}  // namespace rainref::judge
