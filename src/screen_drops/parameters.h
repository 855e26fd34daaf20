// The scene parameters of screen_drops: declared once, for scenes, help, hashing and capture.
#pragma once

#include <span>

#include "rainref/screen_drops.h"
#include "scene/config.h"
#include "scene/parameter.h"

namespace rainref::screen_drops {

std::span<const scene::Parameter> parameters();
/// The settings of a scene. Files and built-in pictures are the caller's.
Settings settings_from(const scene::Config& config);

}  // namespace rainref::screen_drops
