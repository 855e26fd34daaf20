// Owners and fixed views of the textures that passes sample; sampling-inl.h reads them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "base/rows.h"
#include "base/zeroed.h"
#include "rainref/image.h"
#include "rainref/texture.h"

namespace rainref {

/// A view of a Texture whose address rules and channels are fixed when compiling.
template <Address U, Address V, int Count>
struct FixedTexture {
  using Stored = float;
  static constexpr Address address_u = U, address_v = V;
  static constexpr int channels = Count;
  const float* texels;
  int levels;
  const std::int32_t *width, *height, *offset;
  const float* border;
  TexelPrecision precision;
};
/// The texture, which must have these rules and channels.
template <Address U, Address V, int Count>
inline FixedTexture<U, V, Count> fixed_texture(const Texture& t) {
  return {t.texels, t.levels, t.width, t.height, t.offset, t.border, t.precision};
}

/// Owns the texels of a Texture. Made from an Image by exact decoding: half and float keep their values, unorm8 is code / 255 correctly
/// rounded. No colour conversion. `rows` runs the work and does not affect the result.
class TextureData {
 public:
  TextureData() = default;
  /// Level 0 only. Throws Error(usage) if the image has more than 2^31 / channels texels.
  TextureData(const Image& image, Address u, Address v, const Rows& rows = rows_here);
  /// Takes decoded texels of one level.
  TextureData(zeroed::Array<float> texels, int channels, int width, int height, Address u, Address v);
  TextureData(const std::vector<float>& texels, int channels, int width, int height, Address u, Address v);
  TextureData(std::initializer_list<float> texels, int channels, int width, int height, Address u, Address v);

  /// Adds the chain of mip levels down to 1x1. Each level has floor(size / 2) texels a side (at least 1). Each texel is the exact mean of
  /// its footprint in the level above; if a side is odd, with the weights of a polyphase box. So the mean is kept at every size; a 2x2 box
  /// that drops rows would change it. Stops at `levels` levels.
  void build_mips(int levels = Texture::max_levels, const Rows& rows = rows_here);

  const Texture& view() const { return view_; }
  /// The texels, to be rewritten in place.
  float* texels() { return texels_.data(); }
  void set_border(float r, float g, float b, float a);
  bool empty() const { return texels_.empty(); }
  std::size_t bytes() const { return texels_.capacity() * sizeof(float); }

 private:
  zeroed::Array<float> texels_;
  Texture view_;
  void refresh() { view_.texels = texels_.data(); }

 public:
  TextureData(const TextureData& other) : texels_(other.texels_), view_(other.view_) { refresh(); }
  TextureData(TextureData&& other) noexcept : texels_(std::move(other.texels_)), view_(other.view_) { refresh(); }
  TextureData& operator=(TextureData other) noexcept {
    texels_.swap(other.texels_);
    view_ = other.view_;
    refresh();
    return *this;
  }
};

}  // namespace rainref
