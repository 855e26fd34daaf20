// The room's JSON forms. Only the library's forward declarations are named here.
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
/// {"effect": "scenes/x.toml:1:10", "run.fps": "default", …}: where each value came from.
nlohmann::ordered_json origins_json(const Config& config);
/// [{"name", "type", "unit", "minimum", "maximum", "default", "sentence", …}]: a bound that does not exist is null, as
/// is the default of a required parameter; "choices", "variants" and "variant_defaults" are there where they say
/// something.
nlohmann::ordered_json parameters_json(std::span<const Parameter> parameters);
/// {"name", "size", "members": [{"name", "type", "components", "offset", "unit", "sentence"}]}, padding left out.
nlohmann::ordered_json uniform_block_json(const UniformBlock& block);

}  // namespace rainref::scene
