// One value from a scene against one parameter.
#pragma once

#include <string>

#include "scene/config.h"
#include "scene/parameter.h"
#include "scene/toml_reader.h"

namespace rainref::scene {

/// Throws Error(usage): "<place>: <key>: <message>", the place being a file position, a plan's too, or `--set`.
[[noreturn]] void refuse(const Origin& origin, const std::string& key, const std::string& message);

/// The value as the parameter's type: an integer is taken where a real is expected, never the reverse, and -0.0 becomes
/// 0.0, since a quotient by it would be -infinity. Throws Error(usage), placed at the value or at the component that is
/// wrong, with what was expected and what was found.
Value checked(const RawValue& raw, const Parameter& parameter, Origin origin);

}  // namespace rainref::scene
