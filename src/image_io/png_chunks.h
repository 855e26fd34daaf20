// What a PNG file's chunks say, read without libpng.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace rainref::image_io {

/// True when every chunk from the signature to IEND lies within the bytes. The contents are libpng's to judge: it finds
/// damage as well, but would let a file pass that ends behind its last texel, and reports on stderr by itself.
bool png_is_whole(std::span<const std::byte> bytes);

struct PngHeader {
  std::uint32_t width, height;
  int bit_depth;
  int colour_type;  ///< 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA
  bool has_transparent_colour;
};
/// Of a whole file; nothing when its first chunk is no header.
std::optional<PngHeader> parse_png_header(std::span<const std::byte> bytes);

}  // namespace rainref::image_io
