// The programs that a bindings.json names.
#pragma once

#include <map>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "ports/runner/programs.h"

namespace port_runner {

/// What bindings.json of a folder says: formula with revision, as in the manifest, to program. Throws FileError naming the file, the key,
/// what was expected and what was found.
std::map<std::string, Program> programs_of(const nlohmann::json& all, const fs::path& folder);

}  // namespace port_runner
