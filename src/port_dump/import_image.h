// Reads a file that an exporter wrote as a level of a buffer. The expected values show what the file does not say.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "capture/array.h"
#include "port_dump/port_info.h"
#include "port_dump/stored_image.h"

namespace rainref::port_dump {

/// What the user says of a file; nothing: it is to be found.
struct ImportHints {
  std::optional<Origin> origin = std::nullopt;
  std::optional<bool> is_bgra = std::nullopt;           ///< raw bytes of four channels
  std::optional<std::size_t> row_pitch = std::nullopt;  ///< raw bytes
};

struct ImportedLevel {
  std::vector<std::byte> bytes;   ///< canonical: rows from v = 0 on, no padding
  std::vector<std::string> said;  ///< one sentence for each thing that was read or found
};

/// The same rows in the other order.
std::vector<std::byte> turned_over(const std::vector<std::byte>& rows, std::size_t height);

/// Reads `file` as this level of `expected`, an array with its values. The first bytes tell DDS, EXR, PNG and NPY; any other file is raw
/// bytes of the buffer's format, of the same with four channels, or of floats for halves, with rows that are tight or padded alike.
///
/// Each origin, and each layout and channel order that raw bytes allow, is a reading. The one whose values are nearest to the expected ones
/// is taken if at least half of them are near and it is clearly the best; otherwise the first is, top-left and red first, and `said` tells
/// which hint would decide. No value is changed but as read_port_buffer does.
///
/// Throws Error(port_files) with one sentence if no reading fits, Error(io) if the file cannot be read.
ImportedLevel import_level(const std::filesystem::path& file, const capture::Array& expected, int level, const ImportHints& hints,
                           Alpha alpha = Alpha::stored);

}  // namespace rainref::port_dump
