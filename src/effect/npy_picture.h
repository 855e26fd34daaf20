// Pictures as NumPy arrays.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "image_io/read.h"

namespace rainref::effect {

/// True if the file begins like a .npy file; false if it cannot be read.
bool is_npy(const std::filesystem::path& path);

/// An array (height, width) or (height, width, 1, 3 or 4), top row first, as image_io::read returns pictures: <f4 and <f2 are linear, |u1
/// are sRGB codes.
///
/// Throws Error(io) if the file cannot be read. Throws Error(usage) if it holds another kind of array, is damaged, has a NaN or an
/// infinity, or has unequal channels although one quantity is wanted. The message names the file. A depth may be +infinity.
image_io::Picture read_npy(const std::filesystem::path& path, image_io::Content content = image_io::Content::colour);
/// The same for a file with these bytes, without image and hash; the numbers are not checked.
image_io::Picture inspect_npy(const std::filesystem::path& path, std::span<const std::byte> bytes,
                              image_io::Content content = image_io::Content::colour);

}  // namespace rainref::effect
