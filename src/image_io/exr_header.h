// Reads an EXR file's header without OpenEXR, which allocates memory by these numbers before it checks them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rainref::image_io {

struct ExrHeader {
  std::array<std::int32_t, 4> data_window{}, display_window{};  ///< first x and y, last x and y
  int compression = 0;
  bool is_tiled = false;
  std::uint32_t tile_width = 0, tile_height = 0;
  int tile_mode = 0;  ///< 0: one level; else mip or rip levels
};

/// The header of a single-part file that is not deep. Source: OpenEXR, "OpenEXR File Layout". Throws Error(port_files) starting with `file`
/// if it is truncated or damaged, if the file has several parts or deep data, or if the contents of an attribute exceed its size.
ExrHeader parse_exr_header(std::string_view file, std::span<const std::byte> bytes);

/// The value of the string attribute of this name. Throws as parse_exr_header does.
std::optional<std::string> find_exr_text(std::string_view file, std::span<const std::byte> bytes, std::string_view name);

/// "zip", "dwaa": the name of a compression method, or "unknown".
std::string_view exr_compression_name(int compression);
/// True if decoding returns the stored bits, for halves, floats and integers.
bool is_lossless_exr(int compression);

}  // namespace rainref::image_io
