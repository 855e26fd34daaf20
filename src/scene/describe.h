// What a scene may say, for people and for programs.
#pragma once

#include <span>
#include <string>

#include "scene/parameter.h"

namespace rainref::scene {

/// One paragraph a parameter, in the order of the table: a line of aligned columns (key, type, default, range and
/// unit), and under it the sentence, the choices and the variants, wrapped to 100 columns. Ends with a line end.
std::string describe_text(std::span<const Parameter> parameters);

/// parameters_json as indented text.
std::string describe_json(std::span<const Parameter> parameters);

}  // namespace rainref::scene
