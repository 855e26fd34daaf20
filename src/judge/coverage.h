// What the runs of a pass exercise: each side of each decision of its text, and values of what it takes that are not special.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "capture/pass_model.h"
#include "judge/verdict.h"
#include "math/coverage.h"
#include "rainref/executor.h"
#include "scene/uniform_block.h"

namespace rainref::judge {

/// What runs of a pass exercise.
struct Exercise {
  perturbed::Coverage decisions;  ///< of its text
  /// Whether some run has it. "uniform wind.y: neither 0 nor 1" for each component of each uniform that the variant reads; of a flag
  /// "uniform use_probe: 0" and the same of 1. "input bounds: more than one texel" for each image. -1 counts as 1, for a factor of
  /// either hides that it is one.
  std::map<std::string, bool> values;
  void add(const Exercise& other);
  /// All alternatives by name, and whether they were taken: decisions in the order of the text, then values.
  std::vector<std::pair<std::string, bool>> alternatives() const;
};

/// Decisions are counted over all invocations of the case; none where no output is judged by a model (null). Nothing at all is counted
/// of a pass whose outputs are only given. Throws Error(internal) where the effect has no such pass.
Exercise coverage_of(const capture::PassCase& c, const capture::PassModel* model, const parallel::Executor& executor);
/// How many alternatives were taken, and the names of the others. `unexercised`: those that the scene says are not, and why; what nothing
/// can take, whatever the scene, is known (unreached.toml).
PassCoverage summary(const Exercise& exercise, const std::map<std::string, std::string>& unexercised = {});
/// Whether a variant reads a uniform: a sentence that begins with "corrected:" or "as-published:" speaks of that one alone, unless it
/// names the other variant further on.
bool is_read_by(const scene::Member& member, std::string_view variant);
/// "shade.pass.h, refract total reflection: const Vec3<N> bent = ...": the file, the side, the line of the pass text. It does not
/// depend on where the line stands.
std::string alternative(const perturbed::Decision& decision, int side);
/// What nothing can take: alternatives, and why. Made from unreached.toml.
const std::map<std::string, std::string>& unreached();

}  // namespace rainref::judge
