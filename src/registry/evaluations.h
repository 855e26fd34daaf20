// The evaluations that the judge uses, by effect. A program that only simulates does not link them.
#pragma once

#include <string_view>
#include <vector>

#include "capture/pass_model.h"

namespace rainref::registry {

/// The passes of an effect that this build can judge; empty for an effect that it only simulates.
const std::vector<capture::PassEvaluations>& evaluations(std::string_view effect);
/// Adds evaluations of an effect added by registry::add. Call it before anything else, from one thread. Throws Error(internal) if the
/// effect already has some.
void add_evaluations(std::string_view effect, std::vector<capture::PassEvaluations> passes);

}  // namespace rainref::registry
