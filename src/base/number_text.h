// Numbers in texts that users write. Not std::from_chars, which LLVM's library has for no floating-point number before version 20, and not
// std::strtod alone, which reads by the locale of the process.
#pragma once

#include <optional>
#include <string_view>

namespace rainref {

/// The value of the whole text, [-]digits[.digits][e[+-]digits] with a digit before or after the point, rounded once to the nearest, ties
/// to even. Nothing for any other text (spaces, a plus sign in front, "inf", "nan", hexadecimal digits), and for a number so far from 1
/// that it would become infinite, or zero without being zero. T is float or double.
template <class T>
std::optional<T> number_from(std::string_view text);

extern template std::optional<float> number_from(std::string_view);
extern template std::optional<double> number_from(std::string_view);

}  // namespace rainref
