// Decodes the bytes of an image file to samples in the file's own type, by OpenImageIO.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "image_io/channels.h"

namespace rainref::image_io {

enum class FileKind : std::uint8_t { exr, png, hdr, jpeg };

/// Storage type of a channel.
enum class Sample : std::uint8_t { u8, u16, half, float32 };

/// One of the four channels of the result: its offset in a texel of Decoded::texels, or a constant (offset < 0).
struct Channel {
  std::string name;  ///< its name in the file; "" for a constant
  int offset = -1;   ///< bytes from the start of the texel
  Sample sample = Sample::u8;
  bool one = false;  ///< for a constant: 1 instead of 0
};

struct Decoded {
  int width = 0, height = 0;
  int orientation = 1;                     ///< as in EXIF; a JPEG or PNG may be stored turned
  std::vector<std::string> channel_names;  ///< of every channel in the file
  std::array<Channel, 4> channels;         ///< red, green, blue, alpha
  std::string compression;
  bool declared_linear = false;  ///< the file says that its integers are proportional to light
  std::size_t texel_bytes = 0;
  std::unique_ptr<std::byte[]> texels;  ///< row by row from the top of the picture, channels interleaved, native types
};

/// Largest side of a picture [texel].
inline constexpr int max_side = 65536;
/// Puts a codec's reason on one line, and removes a full stop or line break at its end.
std::string one_line(std::string reason);

/// Whether decode fills Decoded::texels.
enum class Texels : std::uint8_t { read, left };

/// Decodes the first picture of a file at its full resolution. `file` is its quoted name and starts every message; `content` and `layer`
/// choose its channels as in pick_quantity and pick_channels. Throws Error(usage) if the bytes are damaged or incomplete, or hold something
/// that rainref does not read: deep or volume data, integer EXR channels, a cropped picture, an EXR or HDR stored rotated, a side over
/// max_side, more memory than the machine has.
Decoded decode(std::string_view file, FileKind kind, std::span<const std::byte> bytes, std::string_view layer, Content content,
               Texels texels = Texels::read);

}  // namespace rainref::image_io
