// The presets that come with rainref, as texts.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scene/presets.h"

namespace rainref::simulation {

/// Those beside the bundled scenes, in order; with `effect`, only those that describe it. Throws as scene::read_presets does.
std::vector<scene::Preset> known_presets(std::string_view effect = "");

/// What a preset sets in a scene of an effect that it describes: each key with its value as TOML. Files have whole paths. Throws
/// Error(usage) with the place for a key that the effect lacks, or a value that it may not have.
std::vector<std::pair<std::string, std::string>> preset_texts(const scene::Preset& preset, const std::string& effect);

}  // namespace rainref::simulation
