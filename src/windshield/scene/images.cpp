#include "windshield/scene/images.h"

#include <algorithm>

#include "math/half.h"
#include "windshield/scene/street.h"

namespace rainref::windshield {

Image opaque_half(const Image& linear) {
  Image out(Format::rgba16f, linear.width(), linear.height());
  for (int y = 0; y < out.height(); ++y) {
    const float* from = linear.row<float>(y);
    Half* to = out.row<Half>(y);
    for (int i = 0; i < 4 * out.width(); ++i) to[i] = to_half(i % 4 == 3 ? 1.0f : std::clamp(from[i], 0.0f, 65504.0f));
  }
  return out;
}

Image far_depth(int width, int height) {
  Image out(Format::r32f, width, height);
  for (int y = 0; y < height; ++y) std::fill_n(out.row<float>(y), width, static_cast<float>(street_far));
  return out;
}

}  // namespace rainref::windshield
