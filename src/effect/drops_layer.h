// The drops of a picture as a separate layer, for an engine that composites them over its own picture.
#pragma once

#include <functional>

#include "rainref/executor.h"
#include "rainref/image.h"

namespace rainref::effect {

/// The drop at one pixel.
struct DropPixel {
  double cover = 0;     ///< share of the pixel that is covered by a drop
  double u = 0, v = 0;  ///< offset from the pixel to the place whose light the drop shows, in widths and heights of the picture
};
/// A drop of round outline on the glass: centre from the picture's lower left corner, and radius [picture heights].
struct DropDisc {
  double x, y, radius;
};
/// Images of the picture's size, row 0 = bottom. A pixel at the rim of a drop is a mix of drop and background, so drops = colour - (1 -
/// coverage) background. Composited over that background, drops + (1 - coverage) background, they give the picture within half a unit in
/// the last place of drops.
struct DropsLayer {
  Image drops;       ///< rgba16f: premultiplied light of the drops, and their coverage
  Image offset;      ///< rg16f: u and v of the pixels, 0 where there is no drop
  Image background;  ///< rgba16f: the linear picture without these drops
};

/// colour: the linear picture; background: the same without drops; both rgba16f. pixel(column, row) is called from several threads.
DropsLayer drops_layer(const Image& colour, Image background, const parallel::Executor& executor,
                       const std::function<DropPixel(int, int)>& pixel);

}  // namespace rainref::effect
