// DDS: uncompressed two-dimensional textures with their mip levels.
//
//   "DDS "  header (124 bytes: size, flags, height, width, pitch, depth, mip levels, ..., pixel format, ...)
//   DX10 header (20 bytes, when the pixel format's code is "DX10": DXGI format, dimension, flags, array size, ...)
//   level 0, level 1, ...: rows without padding
//
// Source: Microsoft, "Programming Guide for DDS" and "DDS_HEADER" (Direct3D documentation).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "port_dump/stored_image.h"

namespace rainref::port_dump {

struct Dds {
  std::vector<StoredImage> levels;  ///< views of the bytes; bottom_up is not set
  std::string format;               ///< for messages: "R16G16B16A16_FLOAT"
  bool is_srgb = false;             ///< the format is sRGB; the codes are as stored
};

/// Accepts a DX10 header, and the older pixel formats with exactly the same meaning: codes 111 to 116 (16- and 32-bit floats), RGBA and
/// BGRA masks of 8 bits, 8-bit luminance. Rows are tight; a padded pitch is read from the header if there is one level and the file's
/// length matches it. `file` is quoted and starts every message.
///
/// Throws Error(port_files): truncated or with surplus bytes, compressed, a cube, a volume, an array, a size beyond 65536, a format that no
/// buffer of rainref has.
Dds parse_dds(std::span<const std::byte> bytes, const std::string& file);

}  // namespace rainref::port_dump
