// What an unknown key of a scene may have meant: a slip of the keyboard, or another word for a key.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/parameter.h"

namespace rainref::scene {

/// The keys that a name may stand for, best first, at most three; empty if no key agrees with it in every word.
///
/// The words of the name, in any order and with or without a table, must each be a word of the key or of its sentence, or mean the same
/// (synonyms.inc); words that say little, as `scene` and `value`, need not. A slip of the keyboard is corrected first. The name of a table
/// with a switch stands for the switch, `condensation` for `condensation.on`. Tables that repeat another are left out.
std::vector<std::string> keys_meant(const std::string& name, const std::string& effect, std::span<const Parameter> parameters);

/// "; did you mean 'a', 'b' or 'c'?"; if no key is meant but a table: where its keys are listed; else "".
std::string did_you_mean_key(const std::string& name, const std::string& effect, std::span<const Parameter> parameters);

}  // namespace rainref::scene
