// Checks one value of a scene against one parameter.
#pragma once

#include <string>

#include "scene/config.h"
#include "scene/parameter.h"
#include "scene/toml_reader.h"

namespace rainref::scene {

/// Throws Error(usage): "<place>: <key>: <message>". The place is a position in a scene or plan file, or `--set`.
[[noreturn]] void refuse(const Origin& origin, const std::string& key, const std::string& message);

/// Converts the value to the parameter's type. An integer is accepted for a real, but not the reverse. -0.0 becomes 0.0, because a division
/// by it would give -infinity. Throws Error(usage) at the place of the value or of the wrong component, with expected and found.
Value checked(const RawValue& raw, const Parameter& parameter, Origin origin);

}  // namespace rainref::scene
