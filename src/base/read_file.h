// A whole file in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "rainref/error.h"

namespace rainref {

/// Reads a regular file. No library reads it, so that disk errors and damaged contents stay apart. Throws Error(io) with the file and the
/// system's reason. Refuses a pipe, a device, a folder, or a file larger than this machine's memory before it allocates anything.
std::vector<std::byte> read_file(const std::filesystem::path& path);

/// Largest accepted size of a file, and the exit code for a larger one.
struct MostBytes {
  std::uint64_t bytes;
  ExitCode code;
};
/// The same for a file from outside, of any size: throws Error(most.code) if it is larger, before it allocates anything.
std::vector<std::byte> read_file(const std::filesystem::path& path, const MostBytes& most);

}  // namespace rainref
