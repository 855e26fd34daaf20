// Scene files as a user names them, and those that came with this program.
#pragma once

#include <string>
#include <vector>

#include "cli/commands.h"
#include "scene/config.h"
#include "simulation/opened.h"

namespace rainref::cli {

/// The scenes below ./scenes, or else the names of those that came with the program: of its installation, or of the sources that it was
/// built from.
std::vector<std::string> known_scenes();

/// scene::load of the options' file and overrides; of a picture that rainref wrote, the scene in it. A file that is not there brings the
/// nearest scene that is into the message.
scene::Config load_scene(const SceneOptions& options);

/// The scene, ready to run; what is doubtful about its files, and what was chosen in reading them, is said on standard error.
simulation::Opened open_scene(const scene::Config& config, const parallel::Executor& executor);

}  // namespace rainref::cli
