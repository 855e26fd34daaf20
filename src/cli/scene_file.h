// Scene files as a user names them.
#pragma once

#include "cli/commands.h"
#include "scene/config.h"
#include "simulation/opened.h"

namespace rainref::cli {

/// scene::load of the options' file and overrides; of a picture that rainref wrote, the scene in it. A file that is not there brings the
/// nearest scene that is into the message.
scene::Config load_scene(const SceneOptions& options);

/// The scene, ready to run; what is doubtful about its files, and what was chosen in reading them, is said on standard error.
simulation::Opened open_scene(const scene::Config& config, const parallel::Executor& executor);

}  // namespace rainref::cli
