// Conversion of texts to numbers, done only here. For floating-point numbers not std::strtod, which depends on the locale, and
// std::from_chars only where the C++ library is known to have it (LLVM's lacks it before version 20).
#pragma once

#include <charconv>
#include <concepts>
#include <optional>
#include <string_view>

namespace rainref {

/// The value of the whole text, [-]digits[.digits][e[+-]digits] with a digit before or after the point, rounded once to nearest, ties to
/// even. Nothing for any other text (spaces, a leading plus sign, "inf", "nan", hexadecimal digits), and for numbers that overflow to
/// infinity or underflow to zero. T is float or double.
template <class T>
std::optional<T> number_from(std::string_view text);

/// The value of the whole text, [-]digits, without a minus sign if T is unsigned. Nothing for any other text, and for a number that T
/// cannot hold. T is an integer type; `base` from 2 to 36, without a prefix.
template <std::integral T>
std::optional<T> whole_from(std::string_view text, int base = 10) {
  T value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, base);
  if (text.empty() || error != std::errc() || stop != end) return std::nullopt;
  return value;
}

extern template std::optional<float> number_from(std::string_view);
extern template std::optional<double> number_from(std::string_view);

}  // namespace rainref
