// Pictures as NumPy arrays.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "image_io/read.h"

namespace rainref::effect {

/// Whether the file begins as a .npy file does; false where it cannot be read.
bool is_npy(const std::filesystem::path& path);

/// An array (height, width) or (height, width, 1, 3 or 4), top row first, as image_io::read gives pictures: <f4 and <f2 are
/// linear, |u1 are sRGB codes.
///
/// Throws Error(io) when the file cannot be read, Error(usage) when it is another array, damaged, or has a NaN or an
/// infinity, or unlike channels where one quantity is wanted; the message names the file. A depth may be +infinity.
image_io::Picture read_npy(const std::filesystem::path& path, image_io::Content content = image_io::Content::colour);
/// What read_npy says of a file with these bytes but for its image and hash; no number is looked at.
image_io::Picture inspect_npy(const std::filesystem::path& path, std::span<const std::byte> bytes,
                              image_io::Content content = image_io::Content::colour);

}  // namespace rainref::effect
