// A whole file in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "rainref/error.h"

namespace rainref {

/// The bytes of a regular file. Read here rather than by a library, so that a failing disk and damaged contents stay
/// apart. Throws Error(io), naming the file and the system's reason; a pipe, a device, a folder, and a file larger than
/// this machine's memory are refused before anything is allocated.
std::vector<std::byte> read_file(const std::filesystem::path& path);

/// Most bytes that a file may have, and the exit code of one that has more.
struct MostBytes {
  std::uint64_t bytes;
  ExitCode code;
};
/// The same of a file that others may have made as long as they like: Error(most.code) where it is longer, before anything is allocated.
std::vector<std::byte> read_file(const std::filesystem::path& path, const MostBytes& most);

}  // namespace rainref
