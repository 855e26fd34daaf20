// PNG of 8 bits without a library, for builds without OpenImageIO: the reports of a page have pictures.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rainref::image_io {

/// The bytes of a file of `height` rows of `width` texels of 1 to 4 channels (grey, grey and alpha, RGB, RGBA), row 0 first. `is_srgb` says
/// so in the file and converts nothing.
std::vector<std::byte> png_file(std::size_t width, std::size_t height, std::size_t channels, std::span<const std::byte> texels,
                                bool is_srgb);

}  // namespace rainref::image_io
