// Tables in short texts: rows parted by one character, fields by another.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace rainref::windshield {

/// The parts of s, without spaces around them; one more than there are separators.
std::vector<std::string_view> split(std::string_view s, char separator);
/// The words of s, parted by any number of spaces.
std::vector<std::string_view> words_of(std::string_view s);
/// The finite number that the whole field is.
std::optional<double> number_of(std::string_view field);

}  // namespace rainref::windshield
