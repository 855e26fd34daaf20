// Images of the caller as the passes store them.
#pragma once

#include "base/rows.h"
#include "rainref/image.h"

namespace rainref::rainy_glass {

/// Four channels as halves, to nearest even; negative colours, which resampled pictures have, become 0, those beyond the
/// halves 65504.
Image colour_as_half(const Image& image, const Rows& rows = rows_here);
/// A map in its storage format, to nearest even.
Image stored_map(const Image& map, Format format);

}  // namespace rainref::rainy_glass
