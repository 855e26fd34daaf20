// Finds a program. CMake compiles one of program_path_<system>.cpp.
#pragma once

#include <filesystem>
#include <string>

namespace rainref {

/// False where no program can be started from this one.
bool starts_programs();
/// The path of a program of this name in the folders of PATH, as a shell finds it; "" if there is none.
std::filesystem::path program_in_path(const std::string& name);

}  // namespace rainref
