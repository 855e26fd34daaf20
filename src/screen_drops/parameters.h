// The scene parameters of screen_drops, declared once for scenes, help, hashing and capture.
#pragma once

#include <optional>
#include <span>

#include "rainref/screen_drops.h"
#include "scene/config.h"
#include "scene/parameter.h"
#include "screen_drops/flow.h"

namespace rainref::screen_drops {

std::span<const scene::Parameter> parameters();
/// The settings of a scene. The caller makes files and built-in pictures.
Settings settings_from(const scene::Config& config);
/// Settings of the flowing water; none as published, or with flow.on = false.
std::optional<FlowSettings> flow_from(const scene::Config& config, const Settings& settings);

}  // namespace rainref::screen_drops
