// Pictures between effects, whose row 0 is the bottom, and files, whose first row is the top.
#pragma once

#include <filesystem>

#include "rainref/image.h"

namespace rainref::cli {

/// The same image with its rows in the other order.
Image flipped(const Image& image);
/// Writes an rgba8 picture (row 0 = bottom) as an RGB PNG.
void write_picture(const std::filesystem::path& path, const Image& picture);

}  // namespace rainref::cli
