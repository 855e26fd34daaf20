// Scene files named by the user.
#pragma once

#include "cli/commands.h"
#include "scene/config.h"
#include "simulation/opened.h"

namespace rainref::cli {

/// scene::load of the options' file and overrides; for a picture that rainref wrote, the scene stored in it. If the file does not exist,
/// the error names the nearest scene.
scene::Config load_scene(const SceneOptions& options);

/// Opens the scene for a run, and calls complain_of.
simulation::Opened open_scene(const scene::Config& config, const parallel::Executor& executor);
/// Warnings about a scene's files, and choices made while reading them, go to standard error.
void complain_of(const effect::Inputs& inputs);

}  // namespace rainref::cli
