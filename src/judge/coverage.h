// What the runs of a pass exercise: each side of each decision of its text.
#pragma once

#include "capture/pass_model.h"
#include "judge/verdict.h"
#include "math/coverage.h"
#include "rainref/executor.h"

namespace rainref::judge {

/// Counted over all invocations of the case; nothing where no output is judged by a model (null).
perturbed::Coverage coverage_of(const capture::PassCase& c, const capture::PassModel* model, const parallel::Executor& executor);
/// How many sides were taken, and the names of the others, such as "shade.pass.h:71 refract: total reflection".
PassCoverage summary(const perturbed::Coverage& coverage);

}  // namespace rainref::judge
