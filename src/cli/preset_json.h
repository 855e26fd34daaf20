// Presets as JSON, for `rainref list` and the page of `rainref view`.
#pragma once

#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace rainref::cli {

/// [{name, kind, sentence, keys: {effect: [[key, its value as TOML], ...]}}, ...] of those that describe the effect; of all for "".
/// Files have whole paths. Throws as simulation::known_presets and simulation::preset_texts do.
nlohmann::ordered_json presets_json(std::string_view effect = "");

}  // namespace rainref::cli
