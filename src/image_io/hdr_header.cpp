#include "image_io/hdr_header.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "base/number_text.h"
#include "rainref/error.h"

namespace rainref::image_io {
namespace {

constexpr std::string_view spaces = " \t\r";
constexpr std::size_t longest_found = 40;

/// Removes and returns the next word of `rest`; "" if there is none.
std::string_view take_word(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(spaces), rest.size()));
  const std::string_view word = rest.substr(0, rest.find_first_of(spaces));
  rest.remove_prefix(word.size());
  return word;
}

/// In the form of printf, also with a leading sign and a capital E.
std::optional<double> factor_from(std::string_view word) {
  std::string text(word.substr(word.starts_with('+') ? 1 : 0));
  std::ranges::replace(text, 'E', 'e');
  const std::optional<double> number = number_from<double>(text);
  return number && *number > 0 ? number : std::nullopt;
}

/// The factors of a line: one for all three, or three.
void multiply(std::string_view file, std::string_view name, std::string_view value, std::size_t count, std::array<double, 3>& product) {
  std::string_view rest = value;
  double last = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    if (k < count) {
      const std::optional<double> factor = factor_from(take_word(rest));
      if (!factor)
        throw Error(ExitCode::usage, fmt::format("{}: {}: expected {} above 0, found '{}'", file, name,
                                                 count == 1 ? "a number" : "three numbers", value.substr(0, longest_found)));
      last = *factor;
    }
    product[k] *= last;
  }
  if (!take_word(rest).empty())
    throw Error(ExitCode::usage, fmt::format("{}: {}: expected {}, found '{}'", file, name, count == 1 ? "one number" : "three numbers",
                                             value.substr(0, longest_found)));
}

}  // namespace

std::array<double, 3> hdr_factors(std::string_view file, std::span<const std::byte> bytes) {
  std::array<double, 3> product{1, 1, 1};
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (line.empty() || line == "\r") break;  // the header's end
    for (const auto& [name, count] : {std::pair<std::string_view, std::size_t>{"EXPOSURE=", 1}, {"COLORCORR=", 3}}) {
      if (line.starts_with(name)) multiply(file, name.substr(0, name.size() - 1), line.substr(name.size()), count, product);
    }
  }
  for (const double factor : product) {
    if (!(factor >= std::numeric_limits<float>::min() && factor <= std::numeric_limits<float>::max()))
      throw Error(ExitCode::usage,
                  fmt::format("{}: the product {:g} of its EXPOSURE and COLORCORR is beyond the range of a float", file, factor));
  }
  return product;
}

}  // namespace rainref::image_io
