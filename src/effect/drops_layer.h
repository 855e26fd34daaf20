// The drops of a picture by themselves, for an engine that puts them over its own.
#pragma once

#include <functional>

#include "rainref/executor.h"
#include "rainref/image.h"

namespace rainref::effect {

/// What a pixel of the drops is.
struct DropPixel {
  double cover = 0;     ///< share of it that is a drop
  double u = 0, v = 0;  ///< from the pixel to the place whose light the drop shows, in widths and heights of the picture
};
/// Of the picture's size, row 0 = bottom.
struct DropsLayer {
  Image drops;   ///< rgba16f: the drops cut out of the linear picture, premultiplied, and their coverage
  Image offset;  ///< rg16f: u and v of the pixels, 0 where there is no drop
};

/// colour: the linear picture, rgba16f. pixel(column, row) is called from several threads.
DropsLayer drops_layer(const Image& colour, const parallel::Executor& executor, const std::function<DropPixel(int, int)>& pixel);

}  // namespace rainref::effect
