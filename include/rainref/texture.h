// Decoded images that passes sample.
#pragma once

#include <cstdint>

namespace rainref {

/// What a lookup outside the image reads.
enum class Address : std::uint8_t {
  clamp,   ///< the nearest texel of the edge
  repeat,  ///< the image is a tile
  mirror,  ///< the image and its mirror image alternate
  border   ///< a constant (zero by default)
};
/// "clamp", "repeat", "mirror" or "border".
constexpr const char* name(Address address) {
  constexpr const char* names[] = {"clamp", "repeat", "mirror", "border"};
  return names[static_cast<int>(address)];
}

/// Storage precision of the texels before they were decoded to float. A texture unit may filter at that precision.
enum class TexelPrecision : std::uint8_t { float32, float16, unorm8 };

/// View of float texels with mip levels. Level l has width[l] x height[l] texels, row-major, channels interleaved, starting at texel
/// offset[l]. Row 0 is v = 0.
struct Texture {
  static constexpr int max_levels = 17;
  const float* texels = nullptr;
  int channels = 0;
  int levels = 0;
  std::int32_t width[max_levels] = {}, height[max_levels] = {}, offset[max_levels] = {};
  Address address_u = Address::clamp, address_v = Address::clamp;
  float border[4] = {0, 0, 0, 0};
  TexelPrecision precision = TexelPrecision::float32;
};

}  // namespace rainref
