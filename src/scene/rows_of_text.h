// Tables in short texts: one character separates rows, another separates fields.
#pragma once

#include <string_view>
#include <vector>

namespace rainref::scene {

/// The parts of s without surrounding spaces; one more than there are separators.
std::vector<std::string_view> split(std::string_view s, char separator);
/// The words of s, separated by any number of spaces.
std::vector<std::string_view> words_of(std::string_view s);

}  // namespace rainref::scene
