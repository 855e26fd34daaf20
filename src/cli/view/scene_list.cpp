#include "cli/view/scene_list.h"

#include <system_error>

#include <nlohmann/json.hpp>

#include "base/path_text.h"
#include "cli/json_text.h"
#include "cli/preset_json.h"
#include "simulation/own_scenes.h"
#include "simulation/scene_index.h"

namespace rainref::cli {
namespace fs = std::filesystem;

SceneList::SceneList(const std::string& named, const fs::path& file) {
  std::error_code none;
  for (const std::string& name : simulation::own_scenes()) {
    const fs::path own = simulation::own_scene(utf8_path(name));
    if (own.empty()) continue;
    const bool is_named = fs::equivalent(own, file, none);
    if (is_named) first_ = name;
    scenes_.emplace(name, Entry{own, is_named ? named : "scenes/" + name});
  }
  if (!first_.empty()) return;
  first_ = path_text(file.filename());
  scenes_.insert_or_assign(first_, Entry{file, named});
}

std::string SceneList::json() const {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& [name, entry] : scenes_) {
    const simulation::KnownScene scene = simulation::known_scene(name, entry.file);
    list.push_back({{"path", name},
                    {"effect", scene.effect},
                    {"variant", scene.variant},
                    {"sentence", scene.sentence.empty() ? "" : scene.sentence + "."},
                    {"files", nlohmann::ordered_json::array()},
                    {"keys", nlohmann::ordered_json::array()},
                    {"file", entry.shown}});
  }
  return json_text({{"scenes", list}, {"presets", presets_json()}});
}

fs::path SceneList::file(std::string_view name) const {
  const auto found = scenes_.find(name);
  return found == scenes_.end() ? fs::path() : found->second.file;
}

}  // namespace rainref::cli
