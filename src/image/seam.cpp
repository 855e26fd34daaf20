#include "image/seam.h"

#include <algorithm>
#include <cmath>

#include "image/texture.h"

namespace rainref {

double seam_ratio(const Image& tile) {
  const TextureData decoded(tile, Address::clamp, Address::clamp);
  const float* texels = decoded.view().texels;
  const int width = tile.width(), height = tile.height(), channels = tile.channels();
  if (width < 3 || height < 3) return 0;
  const auto at = [&](int x, int y, int c) {
    return static_cast<double>(texels[(static_cast<std::ptrdiff_t>(y) * width + x) * channels + c]);
  };
  // B of a raindrop map jumps between cells everywhere, so jumps are compared with jumps.
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

}  // namespace rainref
