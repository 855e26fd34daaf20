#include "simulation/preset_texts.h"

#include "base/path_text.h"
#include "effect/inputs.h"
#include "scene/toml.h"
#include "scene/value_text.h"
#include "simulation/opened.h"

namespace rainref::simulation {

std::vector<scene::Preset> known_presets(std::string_view effect) {
  std::vector<scene::Preset> all = scene::read_presets(effect_table().presets);
  if (!effect.empty()) std::erase_if(all, [&](const scene::Preset& p) { return !p.keys.contains(std::string(effect)); });
  return all;
}

std::vector<std::pair<std::string, std::string>> preset_texts(const scene::Preset& preset, const std::string& effect) {
  const std::vector<std::string> overrides{"effect=" + effect, "variant=corrected", std::string(scene::preset_word) + "=" + preset.name};
  const scene::Config config = scene::parse("", "preset.toml", overrides, effect_table());
  std::vector<std::pair<std::string, std::string>> out;
  for (const scene::RawEntry& e : preset.keys.at(effect)) {
    const scene::Config::Entry& entry = config.entry(e.key);
    const auto* name = std::get_if<std::string>(&entry.value);
    const bool is_file = name && !name->empty() && effect::names_files(e.key);
    out.emplace_back(e.key, scene::value_text(is_file ? path_text(effect::NamedFile(config, e.key).path_of(*name)) : entry.value));
  }
  return out;
}

}  // namespace rainref::simulation
