// Images of the caller as the passes store them.
#pragma once

#include "rainref/image.h"

namespace rainref::rainy_glass {

/// Four channels as halves, to nearest even; negative colours, which resampled pictures have, become 0, those beyond the
/// halves 65504.
Image as_half(const Image& image);
/// A map in its storage format, to nearest even.
Image stored_map(const Image& map, Format format);
Image copy(const Image& image);

}  // namespace rainref::rainy_glass
