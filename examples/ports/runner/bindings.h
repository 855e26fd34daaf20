// The programs of a port's folder, and whether they fit the cases of a pack.
#pragma once

#include <map>
#include <string>

#include "ports/runner/pack.h"
#include "ports/runner/programs.h"

namespace port_runner {

/// DIR/bindings.json. Throws FileError as programs_of() does.
std::map<std::string, Program> read_programs(const fs::path& folder);
/// The shader is there, and each buffer it binds is one of the case's pass. Throws FileError likewise.
void check_program(const fs::path& folder, const Program& program, const Case& of);
/// The value of a fact for this case; throws Error.
std::int32_t value(const Fact& fact, const Case& of);

}  // namespace port_runner
