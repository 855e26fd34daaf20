// JSON files, read with errors that a person can act on.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "ports/runner/npy.h"

namespace port_runner {

/// What the library says of an error, without its own numbers.
inline std::string reason(const nlohmann::json::exception& error) {
  const std::string text = error.what();
  return text.starts_with("[json.") && text.find("] ") != std::string::npos ? text.substr(text.find("] ") + 2) : text;
}

/// Throws FileError naming file, line and column.
inline nlohmann::json parse_json(const fs::path& file) {
  const std::vector<std::uint8_t> bytes = read_file(file);
  try {
    return nlohmann::json::parse(bytes);
  } catch (const nlohmann::json::exception& e) {
    throw FileError(file.string() + ": expected JSON: " + reason(e));
  }
}

}  // namespace port_runner
