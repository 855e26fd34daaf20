// The effects of this build: the only list of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "effect/effect.h"

namespace rainref::registry {

/// All effects, in the order of `rainref list`.
const std::vector<const effect::Effect*>& effects();
/// Returns null for an unknown name.
const effect::Effect* find(std::string_view name);
/// The same; throws Error(usage) with the known names.
const effect::Effect& effect_of_pack(std::string_view name);
/// Adds an effect defined outside rainref, in the calling program. Call it before anything else, from one thread. Throws Error(internal) if
/// the name is taken.
void add(effect::Effect effect);

}  // namespace rainref::registry
