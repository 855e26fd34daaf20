// The effects whose ports this build judges.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "capture/pass_info.h"
#include "capture/pass_model.h"
#include "scene/parameter.h"

namespace rainref::judge {

/// What the judge knows of an effect.
struct KnownEffect {
  const capture::EffectInfo* info;
  std::span<const scene::Parameter> parameters;
  const std::vector<capture::PassEvaluations>* evaluations;
};

/// Null for a name that this build does not know.
const KnownEffect* find_effect(std::string_view name);
/// The same; Error(usage) naming those that it knows.
const KnownEffect& known_effect(std::string_view name);

}  // namespace rainref::judge
