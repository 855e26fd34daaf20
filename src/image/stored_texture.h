// Textures whose texels stay in their storage type. Lanes widen what they fetch, so an image need not be decoded in every frame, and a
// texel of four halves costs one gather. The values are those of a Texture, which the other evaluations use.
#pragma once

#include <cstdint>

#include "image/texture.h"
#include "rainref/image.h"

namespace rainref {

/// Like Texture. Level l has rows of pitch[l] texels; at least 8 readable bytes follow the texels.
template <class S>
struct StoredTexture {
  const S* texels = nullptr;
  int channels = 0, levels = 0;
  std::int32_t width[Texture::max_levels] = {}, height[Texture::max_levels] = {}, offset[Texture::max_levels] = {},
               pitch[Texture::max_levels] = {};
};

/// A view of the image, which must outlive it; S is its storage type, Half or float.
template <class S>
StoredTexture<S> stored_texture(const Image& image) {
  StoredTexture<S> t;
  t.texels = image.row<S>(0);
  t.channels = image.channels();
  t.levels = 1;
  t.width[0] = image.width();
  t.height[0] = image.height();
  t.pitch[0] = static_cast<std::int32_t>(image.stride() / info(image.format()).texel_bytes());
  return t;
}

template <class S, Address U, Address V, int Count>
struct FixedStoredTexture {
  using Stored = S;
  static constexpr Address address_u = U, address_v = V;
  static_assert(U != Address::border && V != Address::border, "a stored texture has no border");
  static constexpr int channels = Count;
  const S* texels;
  int levels;
  const std::int32_t *width, *height, *offset, *pitch;
  static constexpr TexelPrecision precision = sizeof(S) == 2 ? TexelPrecision::float16 : TexelPrecision::float32;
};
template <Address U, Address V, int Count, class S>
FixedStoredTexture<S, U, V, Count> fixed_texture(const StoredTexture<S>& t) {
  return {t.texels, t.levels, t.width, t.height, t.offset, t.pitch};
}

}  // namespace rainref
