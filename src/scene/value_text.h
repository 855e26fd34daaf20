// Values as text: the TOML literal that reads back as the same value.
#pragma once

#include <string>
#include <string_view>

#include "scene/parameter.h"

namespace rainref::scene {

/// The shortest decimal that reads back as the same double, with a point or an exponent so that it stays a real:
/// "2.0", "0.1", "1e+20", "nan".
std::string real_text(double value);
/// A TOML basic string: quotes around, quotes, backslashes and control characters escaped.
std::string toml_string(std::string_view text);
/// The TOML literal of a value: true, 3, [640, 480], 0.5, "text".
std::string value_text(const Value& value);

}  // namespace rainref::scene
