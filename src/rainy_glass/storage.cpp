#include "rainy_glass/storage.h"

#include "base/floating_point.h"
#include "image/half_image.h"
#include "image/seam.h"
#include "image/texture.h"
#include "math/half.h"
#include "math/unorm.h"
#include "rainref/rainy_glass.h"

namespace rainref::rainy_glass {

Image colour_as_half(const Image& image, const Rows& rows) { return as_half(image, rows, 0, 65504); }

Image stored_map(const Image& map, Format format) {
  const TextureData decoded(map, Address::clamp, Address::clamp);
  Image out(format, map.width(), map.height());
  const float* in = decoded.view().texels;
  for (int y = 0; y < map.height(); ++y) {
    for (int i = 0; i < 4 * map.width(); ++i, ++in) {
      if (format == Format::rgba8)
        out.row<Unorm8>(y)[i] = to_unorm8(*in, Rounding::rne);
      else
        out.row<Half>(y)[i] = to_half(*in);
    }
  }
  return out;
}

double seam(const Image& map) {
  const FloatingPointGuard guard;
  return seam_ratio(map);
}

}  // namespace rainref::rainy_glass
