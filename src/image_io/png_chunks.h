// What a PNG file's chunks say.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

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

/// What ends a chunk: the CRC of its type and content. Source: PNG specification, third edition, annex D.
std::uint32_t png_checksum(std::span<const std::byte> type_and_content);

/// The text of the first tEXt chunk with this keyword, or iTXt chunk that is not compressed. Throws Error(usage) starting with `file` when
/// its checksum is another one.
std::optional<std::string> find_png_text(std::string_view file, std::span<const std::byte> bytes, std::string_view keyword);

}  // namespace rainref::image_io
