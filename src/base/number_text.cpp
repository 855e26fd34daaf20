#include "base/number_text.h"

#include <cmath>

#include "base/floating_point.h"
#include "base/number_text_value.h"

namespace rainref {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Removes the digits at the front and returns their number.
std::size_t take_digits(std::string_view& text) {
  std::size_t count = 0;
  while (count < text.size() && is_digit(text[count])) ++count;
  text.remove_prefix(count);
  return count;
}

bool is_number(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  std::size_t seen = take_digits(text);
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    seen += take_digits(text);
  }
  if (seen == 0) return false;
  if (text.empty()) return true;
  if (text.front() != 'e' && text.front() != 'E') return false;
  text.remove_prefix(1);
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  return take_digits(text) > 0 && text.empty();
}

/// Whether all digits before the exponent are 0.
bool is_zero(std::string_view text) {
  return text.substr(0, text.find_first_of("eE")).find_first_of("123456789") == std::string_view::npos;
}

}  // namespace

template <class T>
std::optional<T> number_from(std::string_view text) {
  if (!is_number(text)) return std::nullopt;
  const FloatingPointGuard guard;  // the library rounds in the processor's current mode
  const T value = nearest_value<T>(text);
  if (!std::isfinite(value) || (value == 0 && !is_zero(text))) return std::nullopt;
  return value;
}

template std::optional<float> number_from(std::string_view);
template std::optional<double> number_from(std::string_view);

}  // namespace rainref
