// What rainref asks of OpenImageIO, in no type of its own: a table of functions in a library that is opened at the first picture.
// OpenImageIO brings 250 other libraries, and a program that names it waits a quarter of a second for them before its first line.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "image_io/notes.h"

namespace rainref::image_io {

struct StoredChannel {
  std::string name;
  std::string type;       ///< "uint8", "uint16", "uint", "half", "float": OpenImageIO's names
  std::size_t bytes = 0;  ///< of one sample
};

/// What a file says of its picture.
struct StoredPicture {
  int width = 0, height = 0, depth = 1;
  int x = 0, y = 0;                                             ///< first texel of the data window
  int full_x = 0, full_y = 0, full_width = 0, full_height = 0;  ///< display window
  bool deep = false;
  int orientation = 1;                  ///< as in EXIF; 1 is upright
  std::vector<StoredChannel> channels;  ///< in the file's order
  std::string compression;              ///< EXR's method
  std::string colour_space;             ///< "sRGB", "Linear", ..., or "" where the file says nothing
  Notes notes;                          ///< to be stored; not filled in by readers

  /// Of the channels from `first` to before `end`, interleaved.
  std::size_t texel_bytes(std::size_t first, std::size_t end) const {
    std::size_t bytes = 0;
    for (std::size_t c = first; c < end; ++c) bytes += channels[c].bytes;
    return bytes;
  }
  std::size_t texel_bytes() const { return texel_bytes(0, channels.size()); }
};

/// An opened file. What it throws is a std::exception, whose text is the library's reason.
class PictureReader {
 public:
  virtual ~PictureReader() = default;
  virtual const StoredPicture& picture() const = 0;
  /// Fills `texels`, row by row from the first, with the channels from `first` to before `end`, interleaved, in the file's own types:
  /// no value is converted. Throws also when only a part could be read.
  virtual void read(std::size_t first, std::size_t end, std::byte* texels) = 0;
};

/// The functions. Both give nothing when this OpenImageIO lacks the format or cannot use memory for it, and throw std::exceptions
/// otherwise. Only standard exceptions leave the library: it holds none of rainref's code.
struct Codec {
  /// The first picture of a file at full resolution, without any conversion of alpha or colour. `format` is OpenImageIO's name:
  /// "openexr", "png", "hdr", "jpeg". `bytes` must outlive the reader.
  std::unique_ptr<PictureReader> (*open)(const char* format, std::span<const std::byte> bytes);
  /// The bytes of an EXR of interleaved texels in the channels' types; the same ones at any time. It stores the picture's size,
  /// channels, compression and notes. `name` is for messages.
  std::optional<std::vector<std::byte>> (*encode_exr)(const std::string& name, const StoredPicture& picture, const std::byte* texels);
};

/// Opens the library at the first call, from the run path of the program; any thread may call. Throws Error(io) when it cannot be
/// opened, naming where it was looked for.
const Codec& codec();
/// The same on a thread of its own, beside what the caller does next. Calling the result waits for that thread and throws as codec() does;
/// destroying it waits too. Builds without OpenImageIO have nothing to open and start no thread.
std::function<void()> codec_ahead();
/// Bytes that lie in memory once it is open: about, for OpenImageIO 2.4 with what it brings in Debian 12.
std::size_t codec_bytes();

}  // namespace rainref::image_io
