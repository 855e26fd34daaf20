// Reading pictures: EXR, PNG, Radiance HDR and JPEG files become images of four channels.
#pragma once

#include <filesystem>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/hash.h"
#include "image_io/channels.h"
#include "rainref/image.h"

namespace rainref::image_io {

/// A picture as its file stores it. Row 0 of the image is the top row of the picture; callers that want v = 0 at the bottom flip it. Values
/// are not converted, except for 16-bit integers and for Radiance HDR, which is divided by the factors of its header.
struct Picture {
  /// rgba8 (8-bit files; codes untouched), rgba16f (all channels half; bits untouched) or rgba32f (float; half widened beside float; 16-bit
  /// integers as code / 65535, correctly rounded). Grey is replicated to red, green and blue; an absent alpha is 1. Colours are not
  /// multiplied by alpha.
  Image image;
  std::vector<std::string> channel_names;  ///< of every channel in the file, read or not
  bool srgb_encoded = false;               ///< integers are display-encoded, unless the file declares them linear; floats are linear
  bool lossy = false;                      ///< from a lossy code (EXR DWAA DWAB B44 B44A PXR24, HDR, JPEG): not for goldens or packs
  std::string compression;                 ///< EXR: its method ("zip", "none", ...); else "deflate", "rgbe", "jpeg"
  Hash128 decoded_hash;                    ///< of the image's canonical bytes
  int file_width = 0, file_height = 0;
  std::string taken;                 ///< the channel of a quantity or a depth, stored in red; "" for colours
  std::vector<std::string> remarks;  ///< choices made where the file is ambiguous, a few words each
};

/// Reads the first picture of a file at full resolution. The first bytes determine the file type, not the name. `layer` chooses an EXR
/// layer by the channel names' prefix ("normal" for normal.X); "" is the main one. For a quantity or a depth, pick_quantity selects one
/// channel, which is read into red, green and blue; a depth may be +infinity.
///
/// Throws Error(io) if the file cannot be read. Throws Error(usage) if it cannot be decoded completely, holds something unsupported, has a
/// NaN or an infinity, or has unequal channels although one quantity is wanted; the message names the file, and the first bad pixel and
/// channel.
Picture read(const std::filesystem::path& path, std::string_view layer = {}, Content content = Content::colour);
/// The result of read for a file with these bytes, from its header: image and decoded_hash are empty, and no texel is decoded or checked.
/// Throws as read does.
Picture inspect(const std::filesystem::path& path, std::span<const std::byte> bytes, Content content = Content::colour);

}  // namespace rainref::image_io
