#include "cli/scene_file.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "cli/terminal.h"
#include "rainref/error.h"
#include "rainref/version.h"
#include "scene/toml.h"
#include "simulation/own_scenes.h"
#include "simulation/picture_notes.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> scenes_below(const fs::path& root) {
  std::vector<std::string> found;
  std::error_code none;
  for (const auto& entry : fs::recursive_directory_iterator(root, fs::directory_options::skip_permission_denied, none)) {
    if (entry.path().extension() == ".toml") found.push_back(entry.path().string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// What a user may have meant by a file that is not there: "; did you mean 'x'?" or "".
std::string guess(const fs::path& wrong) {
  std::vector<std::string> names, files;  // what is compared, and the file that it stands for
  const auto add = [&](std::string name, const std::string& file) {
    names.push_back(std::move(name));
    files.push_back(file);
  };
  std::error_code none;
  const fs::path beside = wrong.parent_path();
  std::vector<std::string> siblings;
  for (const auto& entry : fs::directory_iterator(beside.empty() ? "." : beside, none)) {
    if (entry.path().extension() == ".toml") siblings.push_back((beside / entry.path().filename()).string());
  }
  std::sort(siblings.begin(), siblings.end());
  for (const std::string& file : siblings) add(file, file);
  for (const std::string& file : known_scenes()) {
    add(file, file);
    // "puddle/default.toml", "scenes/puddle/default.toml", wherever the folder lies; "default.toml" would be any effect's.
    const fs::path path(file), in_effect = path.parent_path().filename() / path.filename();
    add(in_effect.string(), file);
    add(("scenes" / in_effect).string(), file);
  }
  const std::string near = nearest_name(wrong.lexically_normal().string(), names);
  if (near.empty()) return "";
  return fmt::format("; did you mean '{}'?", files[static_cast<std::size_t>(std::find(names.begin(), names.end(), near) - names.begin())]);
}

}  // namespace

std::vector<std::string> known_scenes() {
  std::vector<std::string> found = scenes_below("scenes");
  return found.empty() ? simulation::own_scenes() : found;
}

scene::Config load_scene(const SceneOptions& options) {
  try {
    if (const auto made = simulation::scene_of_picture(options.scene)) {
      if (made->golden_generation != std::to_string(golden_generation))
        complain(fmt::format("warning: '{}' is of golden generation {}, and this is {}: expect other bits", options.scene.string(),
                             made->golden_generation, golden_generation));
      return scene::parse(made->toml, options.scene, options.overrides, simulation::effect_table());
    }
    return scene::load(options.scene, options.overrides, simulation::effect_table());
  } catch (const Error& e) {
    std::error_code none;
    if (e.code() != ExitCode::io || options.scene.empty() || fs::exists(options.scene, none)) throw;
    throw Error(e.code(), e.what() + guess(options.scene));
  }
}

simulation::Opened open_scene(const scene::Config& config, const parallel::Executor& executor) {
  simulation::Opened opened(config, executor);
  for (const std::string& note : opened.inputs().notes) complain("note: " + note);
  for (const std::string& warning : opened.inputs().warnings) complain("warning: " + warning);
  return opened;
}

}  // namespace rainref::cli
