#include "image/half_image.h"

#include <algorithm>
#include <vector>

#include "image/texture.h"
#include "math/half_array.h"

namespace rainref {

Image as_half(const Image& image, const Rows& rows, float least, float most) {
  const std::size_t count = static_cast<std::size_t>(4) * image.width();
  const bool is_float = image.format() == Format::rgba32f;
  const TextureData decoded = is_float ? TextureData() : TextureData(image, Address::clamp, Address::clamp, rows);
  Image out(Format::rgba16f, image.width(), image.height());
  rows(image.height(), [&](int begin, int end) {
    std::vector<float> held(count);
    for (int y = begin; y < end; ++y) {
      const float* in = is_float ? image.row<float>(y) : decoded.view().texels + static_cast<std::size_t>(y) * count;
      for (std::size_t i = 0; i < count; ++i) held[i] = std::clamp(in[i], least, most);
      to_half_array(held.data(), out.row<Half>(y), count, Rounding::rne);
    }
  });
  return out;
}

}  // namespace rainref
