// The JSON file beside raw bytes, which gives their layout.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "port_dump/port_info.h"
#include "rainref/image.h"

namespace rainref::port_dump {

/// Offsets are from the start of the .bin file.
struct Sidecar {
  bool is_records = false;     ///< `format` is "records"
  Format format = Format::r8;  ///< for an image
  std::size_t width = 0;       ///< texels per row, or records
  std::size_t height = 1;
  std::size_t offset = 0;                                   ///< of the first row or record
  std::size_t row_pitch = 0;                                ///< distance of rows [byte]; 0: no padding
  std::optional<Origin> origin;                             ///< overrides port.json
  bool is_bgra = false;                                     ///< channel_order: blue is first
  std::size_t struct_stride = 0;                            ///< distance of records [byte]; 0: as the pack declares
  std::vector<std::pair<std::string, std::size_t>> fields;  ///< name and offset in a record; none: as the pack declares
  std::optional<bool> is_srgb;                              ///< encoding "srgb" or "linear" of 8-bit codes; nothing if not given
};

/// Keys: format, width (both required), height (required for images), offset, row_pitch, origin, channel_order ("rgba",
/// "bgra"), struct_stride, fields ({"x": 0, "y": 4}), encoding ("linear", "srgb"). `file` is quoted and starts every
/// message. Throws Error(port_files) for an unknown key, a wrong value, and keys that contradict the format.
Sidecar parse_sidecar(std::string_view text, const std::string& file);

}  // namespace rainref::port_dump
