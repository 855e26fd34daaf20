// What the runs of a pass exercise: each side of each decision of its text, and values of what it takes that are not special.
#pragma once

#include <cstdint>
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

/// Something that a run may do, by a name that neither a moved line nor a renamed variable changes.
struct Alternative {
  std::string name;
  bool is_taken;
  std::string guard = "";  ///< why no scene takes it, where the text or the uniform block says so
  int line = 0;            ///< where it stands now; 0: the name is not of one line, or of none
};

/// What runs of a pass exercise.
struct Exercise {
  perturbed::Coverage decisions;  ///< of its text
  /// Whether some run has it. "uniform wind.y: neither 0 nor 1" for each component of each uniform that the variant reads; of a flag
  /// "uniform use_probe: 0" and the same of 1. "input bounds: more than one texel" for each image. -1 counts as 1, for a factor of
  /// either hides that it is one.
  std::map<std::string, bool> values;
  std::map<std::string, std::string> guards;  ///< of values that no scene has: why
  bool is_sampled = false;                    ///< decisions are those of a sample of the invocations
  void add(const Exercise& other);
  /// Decisions in the order of the text, then values.
  std::vector<Alternative> alternatives() const;
};

/// Decisions are counted over all invocations of the case; none where no output is judged by a model (null). Nothing at all is counted
/// of a pass whose outputs are only given. Throws Error(internal) where the effect has no such pass. `sample`: at least so many invocations
/// are counted, drawn as a judgement draws them (judge/sample.h); 0: all. `said`: the uniform block of a pass of a foreign effect.
Exercise coverage_of(const capture::PassCase& c, const capture::PassModel* model, const parallel::Executor& executor,
                     std::int64_t sample = 0, const scene::UniformBlock& said = {});
/// How many alternatives were taken, and the names of the others. `unexercised`: those that the scene says are not, and why.
PassCoverage summary(const Exercise& exercise, const std::map<std::string, std::string>& unexercised = {});
/// Whether a variant reads a uniform: a sentence that begins with "corrected:" or "as-published:" speaks of that one alone, unless it
/// names the other variant further on.
bool is_read_by(const scene::Member& member, std::string_view variant);
/// "shade.pass.h, shade_corrected: clamp 2, below": the file, the function, the decision, the side. number: among the decisions of its
/// kind in the function, in the order of the text; those of guards have numbers of their own. In a shader: "fog.hlsl:25: clamp, below".
std::string name_of(const perturbed::Decision& decision, int number, bool is_guard, int side);

}  // namespace rainref::judge
