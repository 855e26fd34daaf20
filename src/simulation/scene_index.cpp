#include "simulation/scene_index.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "base/path_text.h"
#include "rainref/error.h"
#include "scene/toml_reader.h"
#include "simulation/own_scenes.h"
#include "simulation/picture_notes.h"

namespace rainref::simulation {

std::string scene_sentence(std::string_view toml) {
  std::string text;
  while (toml.starts_with('#')) {
    const std::size_t end = std::min(toml.find('\n'), toml.size());
    std::string_view line = toml.substr(1, end - 1);
    toml.remove_prefix(std::min(end + 1, toml.size()));
    while (line.starts_with(' ')) line.remove_prefix(1);
    while (line.ends_with(' ') || line.ends_with('\r')) line.remove_suffix(1);
    text += (text.empty() || line.empty() ? "" : " ") + std::string(line);
  }
  text = text.substr(0, text.find(". "));
  if (text.ends_with('.')) text.pop_back();
  return text;
}

KnownScene known_scene(const std::string& name, const std::filesystem::path& file) {
  KnownScene scene{name, "", "", ""};
  try {
    const std::string text = scene_text(file);
    scene.sentence = scene_sentence(text);
    for (const scene::RawEntry& entry : scene::read_toml(text, name)) {
      const auto* said = std::get_if<std::string>(&entry.value.data);
      if (said && entry.key == "effect") scene.effect = *said;
      if (said && entry.key == "variant") scene.variant = *said;
    }
  } catch (const Error&) {  // it is listed all the same: running it says what is wrong
  }
  return scene;
}

std::vector<KnownScene> scene_index(std::string_view effect) {
  std::vector<KnownScene> all;
  for (const std::string& name : known_scenes()) {
    KnownScene scene = known_scene(name, find_scene(utf8_path(name)));
    if (effect.empty() || scene.effect == effect) all.push_back(std::move(scene));
  }
  return all;
}

}  // namespace rainref::simulation
