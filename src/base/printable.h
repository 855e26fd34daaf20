// Text of unknown origin, made fit to be shown.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rainref {

/// Bytes of the UTF-8 sequence that starts the text, or 0 where there is none. The Unicode standard's table 3-7: no overlong
/// forms, no surrogates, nothing beyond U+10FFFF.
std::size_t utf8_length(std::string_view text);

/// The text with U+FFFD for what a terminal could take as a command: control characters but line ends and tabs (C0, DEL and
/// C1), and bytes that are no UTF-8.
std::string printable(std::string_view text);

}  // namespace rainref
