#include "cli/scene_file.h"

#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "base/path_text.h"
#include "cli/terminal.h"
#include "rainref/error.h"
#include "rainref/version.h"
#include "scene/toml.h"
#include "simulation/own_scenes.h"
#include "simulation/picture_notes.h"

namespace rainref::cli {

scene::Config load_scene(const SceneOptions& options) {
  try {
    if (const auto made = simulation::scene_of_picture(options.scene)) {
      if (made->golden_generation != std::to_string(golden_generation))
        complain(fmt::format("warning: '{}' is of golden generation {}, and this is {}: expect other bits", path_text(options.scene),
                             made->golden_generation, golden_generation));
      return scene::parse(made->toml, options.scene, options.overrides, simulation::effect_table());
    }
    return scene::load(options.scene, options.overrides, simulation::effect_table());
  } catch (const Error& e) {
    std::error_code none;
    if (e.code() != ExitCode::io || options.scene.empty() || std::filesystem::exists(options.scene, none)) throw;
    throw Error(e.code(), e.what() + simulation::did_you_mean_scene(options.scene));
  }
}

simulation::Opened open_scene(const scene::Config& config, const parallel::Executor& executor) {
  simulation::Opened opened(config, executor);
  complain_of(opened.inputs());
  return opened;
}

void complain_of(const effect::Inputs& inputs) {
  for (const std::string& note : inputs.notes) complain("note: " + note);
  for (const std::string& warning : inputs.warnings) complain("warning: " + warning);
}

}  // namespace rainref::cli
