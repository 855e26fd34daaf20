// The subset of Python literals in .npy headers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rainref::capture {

/// A string, a whole number, True or False, a tuple or list, or a dictionary.
struct PythonLiteral {
  enum Kind : std::uint8_t { string, integer, boolean, tuple, list, dictionary } kind = boolean;
  std::string text;                  ///< value of a string
  std::size_t number = 0;            ///< value of an integer; 0 or 1 for a boolean
  std::vector<std::string> keys;     ///< of a dictionary, one for each item
  std::vector<PythonLiteral> items;  ///< of a tuple, list or dictionary

  bool is_sequence() const { return kind == tuple || kind == list; }
  /// The value of a dictionary's key; null if it has none.
  const PythonLiteral* find(std::string_view key) const;
};

/// Parses a literal, ignoring surrounding white space. Nothing if it is not one, if a number does not fit, if a dictionary repeats a key or
/// has more than 16, or if brackets nest deeper than 8. Strings have no escapes.
std::optional<PythonLiteral> parse_python_literal(std::string_view text);

}  // namespace rainref::capture
