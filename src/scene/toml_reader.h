// Reads TOML text into a flat list of keys and values with their places. Only its source file uses the TOML library.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "rainref/error.h"

namespace rainref::scene {

/// An unchecked value of a scene file.
struct RawValue {
  struct Table {};  ///< an empty table, or one inside an array
  struct Date {};   ///< any TOML date or time; no parameter accepts one
  std::variant<bool, std::int64_t, double, std::string, std::vector<RawValue>, Table, Date> data;
  SourceLocation at;

  /// For messages: a short literal on one line, cut after about 60 characters.
  std::string text() const;
};

struct RawEntry {
  std::string key;    ///< place of the key's last part
  SourceLocation at;  ///< of the key's last part
  RawValue value;
};

/// All leaves and empty tables of a document, in the order of the file. `file` is for messages only.
/// Throws Error(usage) with file, line and column if the text is not TOML, is larger than 1 MiB, or nests keys more deeply than any scene
/// does.
std::vector<RawEntry> read_toml(std::string_view text, const std::string& file);

/// One TOML value, or nothing if the text is not exactly one.
std::optional<RawValue> read_toml_value(std::string_view text);
/// The text itself as a string, or nothing if it is not UTF-8.
std::optional<RawValue> read_bare_text(std::string_view text);

}  // namespace rainref::scene
