// One number per texel, from a picture of several channels.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "rainref/image.h"

namespace rainref::image_io {

/// Throws Error(usage) starting with `file`, which is quoted, at the first texel where two named channels of the first three differ:
/// different channels are not one quantity, and choosing red would be arbitrary. `image` has four channels; row 0 is the top.
void require_alike(std::string_view file, const Image& image, const std::array<std::string, 3>& names);

}  // namespace rainref::image_io
