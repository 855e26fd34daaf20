// JSON as the command line prints it.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace rainref::cli {

/// Indented. A file's name may be no UTF-8; what JSON cannot hold becomes U+FFFD.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace rainref::cli
