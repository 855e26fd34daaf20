// A whole file in memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace rainref {

/// The bytes of a regular file. Read here rather than by a library, so that a failing disk and damaged contents stay
/// apart. Throws Error(io), naming the file and the system's reason; a pipe, a device, a folder, and a file larger than
/// this machine's memory are refused before anything is allocated.
std::vector<std::byte> read_file(const std::filesystem::path& path);

}  // namespace rainref
