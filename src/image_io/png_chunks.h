// Reads the chunks of a PNG file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rainref::image_io {

/// True if every chunk from the signature to IEND lies within the bytes. The contents are left to libpng, which also finds damage, but
/// would accept a file that ends after its last texel, and prints to stderr.
bool png_is_whole(std::span<const std::byte> bytes);

struct PngHeader {
  std::uint32_t width, height;
  int bit_depth;
  int colour_type;  ///< 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA
  bool has_transparent_colour;
};
/// Header of a whole file; nothing if its first chunk is not a header.
std::optional<PngHeader> parse_png_header(std::span<const std::byte> bytes);

/// The checksum at the end of a chunk: the CRC of its type and content. Source: PNG specification, third edition, annex D.
std::uint32_t png_checksum(std::span<const std::byte> type_and_content);

/// The text of the first tEXt chunk with this keyword, or of the first uncompressed iTXt chunk. Throws Error(usage) starting with `file` if
/// its checksum is wrong.
std::optional<std::string> find_png_text(std::string_view file, std::span<const std::byte> bytes, std::string_view keyword);

}  // namespace rainref::image_io
