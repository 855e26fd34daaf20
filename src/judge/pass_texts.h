// The texts of the passes, built in: what a report says of a line.
#pragma once

#include <string_view>

namespace rainref::judge {

/// A line of a pass text without its indentation and its comment; "" for a file or a line that there is not. `file`: with its last
/// folder, "puddle/shade.pass.h".
std::string_view pass_line(std::string_view file, int line);

namespace detail {
/// Of a pass text, or of unreached.toml; "" for another.
std::string_view embedded_text(std::string_view file);
}  // namespace detail

}  // namespace rainref::judge
