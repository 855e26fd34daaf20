// The part of OpenImageIO that rainref uses, without its types: a table of functions in a library that is opened at the first picture.
// OpenImageIO loads 250 other libraries, which delays the start of a program that links it by a quarter of a second.
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

/// The properties of a stored picture.
struct StoredPicture {
  int width = 0, height = 0, depth = 1;
  int x = 0, y = 0;                                             ///< first texel of the data window
  int full_x = 0, full_y = 0, full_width = 0, full_height = 0;  ///< display window
  bool deep = false;
  int orientation = 1;                  ///< as in EXIF; 1 is upright
  std::vector<StoredChannel> channels;  ///< in the file's order
  std::string compression;              ///< EXR's method
  std::string colour_space;             ///< "sRGB", "Linear", ..., or "" if the file does not say
  Notes notes;                          ///< to be stored; readers do not fill it in

  /// Bytes of the channels from `first` to before `end`, interleaved.
  std::size_t texel_bytes(std::size_t first, std::size_t end) const {
    std::size_t bytes = 0;
    for (std::size_t c = first; c < end; ++c) bytes += channels[c].bytes;
    return bytes;
  }
  std::size_t texel_bytes() const { return texel_bytes(0, channels.size()); }
};

/// An opened file. Throws std::exception with the library's reason.
class PictureReader {
 public:
  virtual ~PictureReader() = default;
  virtual const StoredPicture& picture() const = 0;
  /// Fills `texels` row by row with the channels from `first` to before `end`, interleaved, in the file's own types, without conversion.
  /// It is called once. Also throws if only a part could be read.
  virtual void read(std::size_t first, std::size_t end, std::byte* texels) = 0;
};

/// The functions. Both return nothing if this OpenImageIO lacks the format or cannot use memory for it; other failures throw. Only standard
/// exceptions leave the library, because it contains no code of rainref.
struct Codec {
  /// The first picture of a file at full resolution, without any conversion of alpha or colour. `format` is OpenImageIO's name:
  /// "openexr", "png", "hdr", "jpeg". `bytes` must outlive the reader.
  std::unique_ptr<PictureReader> (*open)(const char* format, std::span<const std::byte> bytes);
  /// The bytes of an EXR file with interleaved texels in the channels' types; always the same for the same picture. It stores the picture's
  /// size, channels, compression and notes. `name` is for messages.
  std::optional<std::vector<std::byte>> (*encode_exr)(const std::string& name, const StoredPicture& picture, const std::byte* texels);
};

/// Opens the library at the first call, from the run path of the program. Thread-safe. Throws Error(io) with the searched places if it
/// cannot be opened.
const Codec& codec();
/// Opens it on another thread, while the caller continues. Calling the result waits for that thread and throws as codec() does; destroying
/// it also waits. Builds without OpenImageIO start no thread.
std::function<void()> codec_ahead();
/// Approximate memory [byte] of the opened library, for OpenImageIO 2.4 with its libraries in Debian 12.
std::size_t codec_bytes();

}  // namespace rainref::image_io
