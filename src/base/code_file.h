// The file that this code was loaded from. CMake compiles one of code_file_<platform>.cpp.
#pragma once

#include <filesystem>

namespace rainref {

/// The program or shared library that contains this code; "" if unknown.
std::filesystem::path code_file();

}  // namespace rainref
