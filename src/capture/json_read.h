// JSON that someone else may have written. Its size and its depth are looked at before anything is made of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "rainref/error.h"

namespace rainref::capture {

/// What a document may be, and the exit code of one that is more, or none.
struct JsonLimits {
  std::uint64_t bytes;
  int depth;  ///< objects and lists that a value may lie in
  ExitCode code = ExitCode::port_files;
};
/// Of what people write by hand: port.json, sidecars, a failure of a sweep.
inline constexpr JsonLimits small_json{std::uint64_t{1} << 20, 8};
/// Of what names some files a line: manifests, records of cells, notes of states.
inline constexpr JsonLimits large_json{std::uint64_t{256} << 20, 16};

/// The value that a text is. `name` starts every message. Throws Error(limits.code) for a text that is longer, nests deeper, repeats a key
/// of an object, or is no JSON (with line and column).
nlohmann::ordered_json parse_json(std::string_view text, const std::string& name, const JsonLimits& limits);
/// The same of a file. A longer one is refused before it is read. Throws Error(io) where it cannot be read.
nlohmann::ordered_json read_json(const std::filesystem::path& file, const std::string& name, const JsonLimits& limits);

}  // namespace rainref::capture
