// Where this code was loaded from. One of own_file_<platform>.cpp is compiled, which CMake chooses.
#pragma once

#include <filesystem>

namespace rainref::simulation {

/// The program or shared library that this code is in; "" where that cannot be told.
std::filesystem::path own_file();

}  // namespace rainref::simulation
