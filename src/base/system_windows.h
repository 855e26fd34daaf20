// What the files of base/system.h share on Windows.
#pragma once

#include <windows.h>

#include <filesystem>

namespace rainref::system {

/// Sets errno from GetLastError(). Returns -1.
int fail();
HANDLE handle_of(int descriptor);
/// The file beside a folder on which its lock stands.
std::filesystem::path lock_of(const std::filesystem::path& folder);

}  // namespace rainref::system
