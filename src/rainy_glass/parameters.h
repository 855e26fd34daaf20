// The scene parameters of rainy_glass, declared once for scenes, help, hashing and capture.
#pragma once

#include <span>

#include "rainref/rainy_glass.h"
#include "rainy_glass/backdrop.h"
#include "scene/config.h"
#include "scene/effect_table.h"

namespace rainref::rainy_glass {

std::span<const scene::Parameter> parameters();
/// The settings of a scene. The caller reads the files.
Settings settings_from(const scene::Config& config);
BackdropOptions backdrop_from(const scene::Config& config);

}  // namespace rainref::rainy_glass
