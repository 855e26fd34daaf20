// PNG of 8 bits without a library, for builds without OpenImageIO: the reports of a page have pictures. And text in any PNG.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "image_io/notes.h"

namespace rainref::image_io {

/// The bytes of a file of `height` rows of `width` texels of 1 to 4 channels (grey, grey and alpha, RGB, RGBA), row 0 first. `is_srgb` says
/// so in the file and converts nothing.
std::vector<std::byte> png_file(std::size_t width, std::size_t height, std::size_t channels, std::span<const std::byte> texels,
                                bool is_srgb);

/// The same file with its notes as text. Source: PNG specification, third edition, 11.3.3.
std::vector<std::byte> with_png_text(std::span<const std::byte> file, const Notes& notes);

}  // namespace rainref::image_io
