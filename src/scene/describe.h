// The parameters of a scene, described for people and for programs.
#pragma once

#include <span>
#include <string>

#include "scene/parameter.h"

namespace rainref::scene {

/// One paragraph per parameter, in the order of the table: a line of aligned columns (key, type, default, range and unit), and under it the
/// sentence, the choices and the variants, wrapped to 100 columns. Ends with a newline.
std::string describe_text(std::span<const Parameter> parameters);

/// parameters_json as indented text.
std::string describe_json(std::span<const Parameter> parameters);

}  // namespace rainref::scene
