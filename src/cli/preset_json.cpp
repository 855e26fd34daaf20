#include "cli/preset_json.h"

#include <nlohmann/json.hpp>

#include "simulation/preset_texts.h"

namespace rainref::cli {

nlohmann::ordered_json presets_json(std::string_view effect) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const scene::Preset& preset : simulation::known_presets(effect)) {
    nlohmann::ordered_json keys;
    for (const auto& [name, unused] : preset.keys) keys[name] = simulation::preset_texts(preset, name);
    all.push_back({{"name", preset.name}, {"kind", preset.kind}, {"sentence", preset.sentence}, {"keys", keys}});
  }
  return all;
}

}  // namespace rainref::cli
