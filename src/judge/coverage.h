// What the runs of a pass exercise: each side of each decision of its text.
#pragma once

#include <map>
#include <string>

#include "capture/pass_model.h"
#include "judge/verdict.h"
#include "math/coverage.h"
#include "rainref/executor.h"

namespace rainref::judge {

/// Counted over all invocations of the case; nothing where no output is judged by a model (null).
perturbed::Coverage coverage_of(const capture::PassCase& c, const capture::PassModel* model, const parallel::Executor& executor);
/// How many sides were taken, and the names of the others. `unexercised`: those that the scene says are not, and why; what nothing can
/// take, whatever the scene, is known (unreached.toml).
PassCoverage summary(const perturbed::Coverage& coverage, const std::map<std::string, std::string>& unexercised = {});
/// "shade.pass.h, refract total reflection: const Vec3<N> bent = ...": the file, the side, the line of the pass text. It does not
/// depend on where the line stands.
std::string alternative(const perturbed::Decision& decision, int side);
/// What nothing can take: alternatives, and why. Made from unreached.toml.
const std::map<std::string, std::string>& unreached();

}  // namespace rainref::judge
