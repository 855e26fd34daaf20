#include "windshield/scene_images.h"

#include <algorithm>
#include <array>

#include "image/colour.h"
#include "image/texture.h"
#include "math/half.h"
#include "windshield/street.h"

namespace rainref::windshield {

Image linear_half(const Image& picture, bool is_encoded) {
  const TextureData decoded(picture, Address::clamp, Address::clamp);
  const int channels = picture.channels();
  std::array<float, 256> codes;  // 8-bit pictures have few values
  for (int k = 0; k < 256; ++k) codes[static_cast<std::size_t>(k)] = static_cast<float>(decode_srgb(k / 255.0));
  const bool is_8_bit = info(picture.format()).channel_bytes == 1;
  Image out(Format::rgba16f, picture.width(), picture.height());
  for (int y = 0; y < out.height(); ++y) {
    Half* to = out.row<Half>(y);
    const float* from = decoded.view().texels + static_cast<std::size_t>(y) * out.width() * channels;
    for (int x = 0; x < out.width(); ++x, from += channels, to += 4) {
      for (int c = 0; c < 3; ++c) {
        const float v = std::clamp(from[c < channels ? c : 0], 0.0f, 65504.0f);
        const float linear = !is_encoded ? v : is_8_bit ? codes[static_cast<std::size_t>(v * 255 + 0.5f)] : static_cast<float>(decode_srgb(std::min(v, 1.0f)));
        to[c] = to_half(linear);
      }
      to[3] = to_half(1.0f);
    }
  }
  return out;
}

Image depth_of(const Image& picture) {
  const TextureData decoded(picture, Address::clamp, Address::clamp);
  const int channels = picture.channels();
  Image out(Format::r32f, picture.width(), picture.height());
  for (int y = 0; y < out.height(); ++y) {
    const float* from = decoded.view().texels + static_cast<std::size_t>(y) * out.width() * channels;
    for (int x = 0; x < out.width(); ++x) out.row<float>(y)[x] = std::max(from[x * channels], 0.0f);
  }
  return out;
}

Image far_depth(int width, int height) {
  Image out(Format::r32f, width, height);
  for (int y = 0; y < height; ++y) std::fill_n(out.row<float>(y), width, static_cast<float>(street_far));
  return out;
}

}  // namespace rainref::windshield
