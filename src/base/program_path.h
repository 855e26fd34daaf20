// Where a program lies.
#pragma once

#include <filesystem>
#include <string>

namespace rainref {

/// A program of this name in the folders of PATH, as a shell finds it; "" where there is none.
std::filesystem::path program_in_path(const std::string& name);

}  // namespace rainref
