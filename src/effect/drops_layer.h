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
/// Of the picture's size, row 0 = bottom. A pixel of a drop's rim is a mix of drop and background already, so that the drop is what the
/// background leaves open: drops = colour - (1 - coverage) background. Laid over that background, drops + (1 - coverage) background, they
/// give the picture within half a last place of drops.
struct DropsLayer {
  Image drops;       ///< rgba16f: premultiplied light of the drops alone, and their coverage
  Image offset;      ///< rg16f: u and v of the pixels, 0 where there is no drop
  Image background;  ///< rgba16f: the linear picture without these drops
};

/// colour: the linear picture, background: the same without the drops, both rgba16f. pixel(column, row) is called from several threads.
DropsLayer drops_layer(const Image& colour, Image background, const parallel::Executor& executor,
                       const std::function<DropPixel(int, int)>& pixel);

}  // namespace rainref::effect
