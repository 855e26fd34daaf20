// Values of options that are text on the command line.
#pragma once

#include <string>
#include <vector>

namespace rainref::cli {

/// A whole number from `low` to `high`; Error(usage) naming the option for anything else.
int whole_number(const std::string& text, const char* option, int low, int high);

/// The parts of "a,b,c"; one empty part of "".
std::vector<std::string> list_of(const std::string& text);

/// One of these words; Error(usage) naming the option, `expected` and the nearest word for anything else.
void require_word(const std::string& text, const char* option, const char* expected, const std::vector<std::string>& words);

/// What is to be written somewhere; Error(usage) naming the option and `expected` where it is "".
void require_text(const std::string& text, const char* option, const char* expected);

}  // namespace rainref::cli
