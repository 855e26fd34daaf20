// Finds the file of a dump that holds a buffer.
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
  std::filesystem::path sidecar;  ///< for a .bin

  /// The path in quotes, with which messages begin.
  std::string quoted() const;
};

/// The one file of this stem in the folder: <stem>.npy, .exr, .dds, .png, or .bin with .json beside it.
///
/// Throws Error(port_files) if there is none (with the searched names, an unsupported file and the reason, or the nearest name in the
/// folder), if there are several, or if one of .bin and .json is missing.
DumpFile find_dump_file(const std::filesystem::path& folder, std::string_view stem);

/// Reads a port's file of at most `most` bytes. Throws Error(port_files) for one that is longer or no regular file: a folder, a pipe, a
/// socket, a device. Throws Error(io) if it cannot be read.
std::vector<std::byte> read_port_file(const std::filesystem::path& path, std::uint64_t most);

}  // namespace rainref::port_dump
