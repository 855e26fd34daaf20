// The file that this code was loaded from. CMake compiles one of own_file_<platform>.cpp.
#pragma once

#include <filesystem>

namespace rainref::simulation {

/// The program or shared library that contains this code; "" if unknown.
std::filesystem::path own_file();

}  // namespace rainref::simulation
