// Captured images as passes take them that read a texel's neighbours and write an image of the same size.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "capture/bound_texture.h"

namespace rainref::drops {

/// The input of this name, of the size of the first output. Throws Error(port_files) where it is missing or has another.
const capture::CaseInput& sized_input(const capture::PassCase& c, const char* name);

/// The first channel of an image, whose rows are readable one texel to every side, where the nearest texel stands again.
class Framed {
 public:
  Framed() = default;
  explicit Framed(const capture::CaseInput& input) : width_(input.array.width), height_(input.array.height) {
    const std::vector<float> all = capture::decoded(input.array);
    const std::size_t channels = static_cast<std::size_t>(info(input.array.format).channels);
    for (int y = 0; y < height_; ++y)
      for (int x = -1; x <= width_; ++x)
        texels_.push_back(all[channels * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                          static_cast<std::size_t>(std::clamp(x, 0, width_ - 1)))]);
  }
  /// Texel 0 of the row y or the nearest one.
  const float* row(int y) const { return texels_.data() + static_cast<std::ptrdiff_t>(std::clamp(y, 0, height_ - 1)) * (width_ + 2) + 1; }

 private:
  int width_ = 0, height_ = 0;
  std::vector<float> texels_;
};

}  // namespace rainref::drops
