#include "cli/view/scene_list.h"

#include <system_error>

#include <nlohmann/json.hpp>

#include "base/path_text.h"
#include "rainref/error.h"
#include "simulation/own_scenes.h"
#include "simulation/picture_notes.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;

/// The value of a line `key = "value"` before the first section; "" if there is none.
std::string text_of(std::string_view toml, std::string_view key) {
  for (std::size_t at = 0; at < toml.size();) {
    const std::size_t end = std::min(toml.find('\n', at), toml.size());
    const std::string_view line = toml.substr(at, end - at);
    at = end + 1;
    if (line.starts_with('[')) break;
    const std::size_t from = line.find_first_of("\"'");
    if (!line.starts_with(key) || line.substr(key.size()).find_first_not_of(" =") != from - key.size()) continue;
    const std::size_t to = line.find(line[from], from + 1);
    if (to != std::string_view::npos) return std::string(line.substr(from + 1, to - from - 1));
  }
  return "";
}

/// The first sentence of the comment at the beginning.
std::string sentence_of(std::string_view toml) {
  std::string words;
  for (std::size_t at = 0; at < toml.size() && toml[at] == '#';) {
    const std::size_t end = std::min(toml.find('\n', at), toml.size());
    std::string_view line = toml.substr(at + 1, end - at - 1);
    at = end + 1;
    if (line.starts_with(' ')) line.remove_prefix(1);
    if (line.starts_with("  ")) break;  // a command
    words += (words.empty() ? "" : " ") + std::string(line);
  }
  for (std::size_t at = 0; (at = words.find_first_of(".:", at)) != std::string::npos; ++at)
    if (at + 1 == words.size() || words[at + 1] == ' ') return words.substr(0, at) + ".";
  return words;
}

}  // namespace

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
    try {
      const std::string toml = simulation::scene_text(entry.file);
      list.push_back({{"path", name},
                      {"effect", text_of(toml, "effect")},
                      {"variant", text_of(toml, "variant")},
                      {"sentence", sentence_of(toml)},
                      {"files", nlohmann::ordered_json::array()},
                      {"keys", nlohmann::ordered_json::array()},
                      {"file", entry.shown}});
    } catch (const Error&) {  // a file that went away; asking for it says why
    }
  }
  return nlohmann::ordered_json{{"scenes", list}}.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

fs::path SceneList::file(std::string_view name) const {
  const auto found = scenes_.find(name);
  return found == scenes_.end() ? fs::path() : found->second.file;
}

}  // namespace rainref::cli
