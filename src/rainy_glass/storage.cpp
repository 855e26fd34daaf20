#include "rainy_glass/storage.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/floating_point.h"
#include "image/seam.h"
#include "image/texture.h"
#include "math/half.h"
#include "math/unorm.h"
#include "rainref/rainy_glass.h"

namespace rainref::rainy_glass {

Image as_half(const Image& image) {
  const TextureData decoded(image, Address::clamp, Address::clamp);
  Image out(Format::rgba16f, image.width(), image.height());
  const float* in = decoded.view().texels;
  for (int y = 0; y < image.height(); ++y) {
    Half* row = out.row<Half>(y);
    for (int i = 0; i < 4 * image.width(); ++i) row[i] = to_half(std::clamp(*in++, 0.0f, 65504.0f));
  }
  return out;
}

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

Image copy(const Image& image) {
  Image out(image.format(), image.width(), image.height());
  const std::size_t bytes = BufferView(image).row_bytes();
  for (int y = 0; y < image.height(); ++y) std::memcpy(out.row_bytes(y), image.row_bytes(y), bytes);
  return out;
}

double seam(const Image& map) {
  const FloatingPointGuard guard;
  return seam_ratio(map);
}

}  // namespace rainref::rainy_glass
