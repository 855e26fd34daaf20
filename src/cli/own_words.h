// How this process was started, as own_program_posix.cpp needs it. CMake compiles one of own_words_<system>.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rainref::cli {

/// A name of this program's file that starts the same program again; it lives as long as the process.
const char* own_program_name();

}  // namespace rainref::cli
