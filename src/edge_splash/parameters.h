// The scene parameters of edge_splash, declared once for scenes, help, hashing and capture.
#pragma once

#include <span>

#include "rainref/edge_splash.h"
#include "scene/config.h"
#include "scene/parameter.h"

namespace rainref::edge_splash {

std::span<const scene::Parameter> parameters();
/// The settings of a scene. The caller makes image files and built-in pictures.
Settings settings_from(const scene::Config& config);

}  // namespace rainref::edge_splash
