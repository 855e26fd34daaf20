// Which file of a dump holds a buffer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rainref::port_dump {

enum class FileType : std::uint8_t { npy, exr, dds, png, bin };

struct DumpFile {
  std::filesystem::path path;
  FileType type;
  std::filesystem::path sidecar;  ///< of a .bin

  /// The path in quotes, as messages begin.
  std::string quoted() const;
};

/// The one file of this stem in the folder: <stem>.npy, .exr, .dds, .png, or .bin with .json beside it.
///
/// Throws Error(port_files) when there is none (naming what was looked for, a file of a kind that is refused and why,
/// or the nearest name in the folder), when there are several, or when .bin and .json are not together.
DumpFile find_dump_file(const std::filesystem::path& folder, std::string_view stem);

/// The bytes of a port's file, at most so many. Throws Error(port_files) for one that is longer or no regular file: a folder, a pipe, a
/// socket, a device; Error(io) where it cannot be read.
std::vector<std::byte> read_port_file(const std::filesystem::path& path, std::uint64_t most);

}  // namespace rainref::port_dump
