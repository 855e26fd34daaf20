// JSON forms of this room. This file uses only the library's forward declarations.
#pragma once

#include <span>

#include <nlohmann/json_fwd.hpp>

#include "scene/config.h"
#include "scene/parameter.h"
#include "scene/uniform_block.h"

namespace rainref::scene {

/// true, 3, [640, 480], 0.5, "text".
nlohmann::ordered_json value_json(const Value& value);
/// {"effect": …, "run.size": [1280, 720], …}: every key and its value, in the order of declaration.
nlohmann::ordered_json config_json(const Config& config);
/// {"effect": "scenes/x.toml:1:10", "run.fps": "default", …}: the origin of each value.
nlohmann::ordered_json origins_json(const Config& config);
/// [{"name", "type", "unit", "minimum", "maximum", "default", "sentence", …}]: a missing bound is null, as is the default of a required
/// parameter. "choices", "variants" and "variant_defaults" are present only if they are not empty.
nlohmann::ordered_json parameters_json(std::span<const Parameter> parameters);
/// {"name", "size", "members": [{"name", "type", "components", "offset", "unit", "sentence"}]}, without padding.
nlohmann::ordered_json uniform_block_json(const UniformBlock& block);

}  // namespace rainref::scene
