// Reading pictures: EXR, PNG, Radiance HDR and JPEG files become images of four channels.
#pragma once

#include <filesystem>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/hash.h"
#include "rainref/image.h"

namespace rainref::image_io {

/// A picture as its file stores it. Row 0 of the image is the top row of the picture; who wants v = 0 at the bottom
/// flips. No value was converted, but for 16-bit integers.
struct Picture {
  /// rgba8 (8-bit files; codes untouched), rgba16f (all channels half; bits untouched) or rgba32f (float; half widened
  /// beside float; 16-bit integers as code / 65535, correctly rounded). Grey is replicated to red, green and blue; an
  /// absent alpha is 1. Colour is not multiplied by alpha.
  Image image;
  std::vector<std::string> channel_names;  ///< of every channel in the file, read or not
  bool srgb_encoded = false;               ///< integers are display-encoded, unless the file declares them linear; floats are linear
  bool lossy = false;                      ///< from a lossy code (EXR DWAA DWAB B44 B44A PXR24, HDR, JPEG): not for goldens or packs
  std::string compression;                 ///< EXR: its method ("zip", "none", ...); else "deflate", "rgbe", "jpeg"
  Hash128 decoded_hash;                    ///< of the image's canonical bytes
  int file_width = 0, file_height = 0;
};

/// Reads the first picture of a file at full resolution. What the file is, its first bytes say, not its name. `layer`
/// chooses an EXR layer by the channel names' prefix ("normal" for normal.X); "" is the main one.
///
/// Throws Error(io) when the file cannot be read, Error(usage) when it cannot be decoded whole, holds something
/// unsupported, or has a NaN or an infinity; the message names the file, and the first bad pixel and channel.
Picture read(const std::filesystem::path& path, std::string_view layer = {});
/// What read says of a file with these bytes, as far as its header says it: image and decoded_hash are empty, and no texel is decoded
/// or checked. Throws as read.
Picture inspect(const std::filesystem::path& path, std::span<const std::byte> bytes, std::string_view layer = {});

}  // namespace rainref::image_io
