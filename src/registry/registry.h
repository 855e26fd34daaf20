// The effects that this build has: the one list of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "effect/effect.h"

namespace rainref::registry {

/// All of them, in the order in which `rainref list` names them.
const std::vector<const effect::Effect*>& effects();
/// Null for a name that this build does not know.
const effect::Effect* find(std::string_view name);
/// The same; Error(usage) naming those that it knows.
const effect::Effect& effect_of_pack(std::string_view name);
/// Adds an effect that lives outside of rainref, a program's own. Call it before anything else, from one thread. Throws Error(internal)
/// where its name is taken.
void add(effect::Effect effect);

}  // namespace rainref::registry
