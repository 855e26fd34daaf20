// Reads untrusted JSON. Checks its size and depth before parsing it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "rainref/error.h"

namespace rainref::capture {

/// Limits of a document, and the exit code if it exceeds them or is not JSON.
struct JsonLimits {
  std::uint64_t bytes;
  int depth;  ///< nesting of objects and lists
  ExitCode code = ExitCode::port_files;
};
/// For files written by hand: port.json, sidecars, the error file of a sweep.
inline constexpr JsonLimits small_json{std::uint64_t{1} << 20, 8};
/// For files that list other files: manifests, records of cells, notes of states.
inline constexpr JsonLimits large_json{std::uint64_t{256} << 20, 16};

/// Parses a text. `name` starts every message. Throws Error(limits.code) for a text that is too long, is nested too deeply, repeats a key
/// of an object, or is not JSON (with line and column).
nlohmann::ordered_json parse_json(std::string_view text, const std::string& name, const JsonLimits& limits);
/// Parses a file. Rejects a file that is too long before reading it. Throws Error(io) if it cannot be read.
nlohmann::ordered_json read_json(const std::filesystem::path& file, const std::string& name, const JsonLimits& limits);

}  // namespace rainref::capture
