// Texts that a shell takes as one word.
#pragma once

#include <string>
#include <string_view>

namespace rainref::cli {

/// True if a text has only ASCII letters, digits and these marks.
bool is_plain(std::string_view text, std::string_view marks);
/// A word as it is typed: as it is if it is plain, else between quotes, with `inside` in place of each quote.
std::string quoted_word(std::string_view word, std::string_view marks, char quote, std::string_view inside);

}  // namespace rainref::cli
