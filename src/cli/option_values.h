// Parsing of option values.
#pragma once

#include <string>
#include <vector>

namespace rainref::cli {

/// An integer from `low` to `high`; Error(usage) naming the option for anything else.
int whole_number(const std::string& text, const char* option, int low, int high);

/// The parts of "a, b,c", without the spaces about them; one empty part for "".
std::vector<std::string> list_of(const std::string& text);

/// Checks that the text is one of these words; otherwise Error(usage) naming the option, `expected` and the nearest word.
void require_word(const std::string& text, const char* option, const char* expected, const std::vector<std::string>& words);

/// Checks that a path to write is not ""; otherwise Error(usage) naming the option and `expected`.
void require_text(const std::string& text, const char* option, const char* expected);

}  // namespace rainref::cli
