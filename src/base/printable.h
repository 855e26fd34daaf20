// Makes text of unknown origin safe to print.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rainref {

/// Length [byte] of the UTF-8 sequence at the start of the text, or 0 if there is none. By the Unicode standard's table 3-7: no overlong
/// forms, no surrogates, nothing beyond U+10FFFF.
std::size_t utf8_length(std::string_view text);

/// Returns the text with U+FFFD in place of everything that a terminal could take as a command: control characters except line ends and
/// tabs (C0, DEL and C1), and bytes that are not UTF-8.
std::string printable(std::string_view text);

}  // namespace rainref
