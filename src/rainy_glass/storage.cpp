#include "rainy_glass/storage.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/floating_point.h"
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
  const TextureData decoded(map, Address::clamp, Address::clamp);
  const float* texels = decoded.view().texels;
  const int width = map.width(), height = map.height(), channels = map.channels();
  if (width < 3 || height < 3) return 0;
  const auto at = [&](int x, int y, int c) {
    return static_cast<double>(texels[(static_cast<std::ptrdiff_t>(y) * width + x) * channels + c]);
  };
  // B of a raindrop map jumps from cell to cell everywhere, so jumps are compared with jumps.
  double edge = 0, inside = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c) {
        const double across = std::abs(at(x, y, c) - at((x + 1) % width, y, c)), along = std::abs(at(x, y, c) - at(x, (y + 1) % height, c));
        (x + 1 == width ? edge : inside) += across / (x + 1 == width ? height : static_cast<double>(width - 1) * height);
        (y + 1 == height ? edge : inside) += along / (y + 1 == height ? width : static_cast<double>(height - 1) * width);
      }
    }
  }
  return edge <= 1e-6 ? 0 : edge / std::max(inside, 1e-6);
}

}  // namespace rainref::rainy_glass
