// JSON for the command line's output.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace rainref::cli {

/// Indented. A file's name may be invalid UTF-8; invalid bytes become U+FFFD.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace rainref::cli
