// The puddle's scene parameters, declared once for scenes, help, hashing and capture.
#pragma once

#include <span>

#include "rainref/puddle.h"
#include "scene/config.h"
#include "scene/effect_table.h"
#include "scene/uniform_block.h"

namespace rainref::puddle {

std::span<const scene::Parameter> parameters();
/// The settings of a scene. The caller reads the environment and ground files.
Settings settings_from(const scene::Config& config);

}  // namespace rainref::puddle
