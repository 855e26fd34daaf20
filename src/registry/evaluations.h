// What the judge evaluates, by effect. A program that only simulates links none of it.
#pragma once

#include <string_view>
#include <vector>

#include "capture/pass_model.h"

namespace rainref::registry {

/// Each pass of an effect that this build judges; empty for an effect that it only simulates.
const std::vector<capture::PassEvaluations>& evaluations(std::string_view effect);
/// Those of an effect that was added (registry::add). Call it before anything else, from one thread. Throws Error(internal) where the
/// effect has some.
void add_evaluations(std::string_view effect, std::vector<capture::PassEvaluations> passes);

}  // namespace rainref::registry
