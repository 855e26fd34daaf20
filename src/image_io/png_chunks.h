// Whether a PNG file goes on to its end mark.
#pragma once

#include <cstddef>
#include <span>

namespace rainref::image_io {

/// True when every chunk from the signature to IEND lies within the bytes. The contents are libpng's to judge: it finds
/// damage as well, but would let a file pass that ends behind its last texel, and reports on stderr by itself.
bool png_is_whole(std::span<const std::byte> bytes);

}  // namespace rainref::image_io
