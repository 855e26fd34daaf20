// Counts what the runs of a pass exercise: the sides of each decision, and values of its inputs that are not special.
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

/// Something that a run may exercise. Its name is independent of line numbers and variable names.
struct Alternative {
  std::string name;
  bool is_taken;
  std::string guard = "";  ///< why no scene takes it, from the pass text or the uniform block
  int line = 0;            ///< its present line; 0: no line, or several
};

/// What the runs of a pass exercise.
struct Exercise {
  perturbed::Coverage decisions;  ///< of the pass text
  /// True if some run has the value. "uniform wind.y: neither 0 nor 1" for each component of each uniform that the variant reads; for a
  /// flag "uniform use_probe: 0" and the same with 1. "input bounds: more than one texel" for each image. -1 counts as 1, because a factor
  /// of either value is invisible.
  std::map<std::string, bool> values;
  std::map<std::string, std::string> guards;  ///< why no scene has a value
  bool is_sampled = false;                    ///< decisions come from a sample of the invocations
  void add(const Exercise& other);
  /// Returns the decisions in the order of the text, then the values.
  std::vector<Alternative> alternatives() const;
};

/// Counts decisions over all invocations of the case; none if no output is judged by a model (null). Counts nothing for a pass whose
/// outputs are only given. Throws Error(internal) if the effect has no such pass. `sample`: the least number of invocations to count, drawn
/// as for a judgement (judge/sample.h); 0: all. `said`: the uniform block of a foreign effect's pass.
Exercise coverage_of(const capture::PassCase& c, const capture::PassModel* model, const parallel::Executor& executor,
                     std::int64_t sample = 0, const scene::UniformBlock& said = {});
/// Number of alternatives taken, and the names of the others. `unexercised`: those that the scene declares as not taken, and why.
PassCoverage summary(const Exercise& exercise, const std::map<std::string, std::string>& unexercised = {});
/// True if a variant reads a uniform. A sentence that begins with "corrected:" or "as-published:" concerns only that variant, unless it
/// names the other one later.
bool is_read_by(const scene::Member& member, std::string_view variant);
/// "shade.pass.h, shade_corrected: clamp 2, below": file, function, decision, side. number: counts decisions of this kind in the function,
/// in the order of the text; guards are counted separately. In a shader: "fog.hlsl:25: clamp, below".
std::string name_of(const perturbed::Decision& decision, int number, bool is_guard, int side);

}  // namespace rainref::judge
