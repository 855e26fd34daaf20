// JSON as the command line prints it.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace rainref::cli {

/// Indented. A file's name may be no UTF-8; what JSON cannot hold becomes U+FFFD.
inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace rainref::cli
