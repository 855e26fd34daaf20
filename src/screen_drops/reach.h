// The water that may be visible in a stretch of a row, so that drops skips the rest: most of a window is dry, and most of a layer's cells
// are empty.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "image/stored_texture.h"
#include "screen_drops/uniforms.h"

namespace rainref::screen_drops {

/// If it answers no, drops_corrected would find no cover; this is always right. It may answer yes for a dry stretch.
class Reach {
 public:
  /// For rows of `columns` pixels in stretches of `stretch`; cells, height: the inputs of drops, which must outlive it.
  Reach(const DropsUniforms& uniforms, const StoredTexture<float>& cells, const StoredTexture<Half>& height, int columns, int stretch);
  void enter_row(int row);
  /// The water of a stretch of that row.
  Wanted of(int stretch) const {
    const Span& s = spans_[static_cast<std::size_t>(stretch)];
    Wanted wanted = u_.has_flow != 0 && before_texel_[s.texel_end] != before_texel_[s.texel] ? wanted_flow : 0;
    for (std::size_t l = 0; l < layers; ++l)
      wanted |= static_cast<Wanted>(before_cell_[l][s.cell_end[l]] != before_cell_[l][s.cell[l]]) << l;
    return wanted;
  }

 private:
  /// The cells and texels under a stretch, without the ends.
  struct Span {
    std::uint32_t cell[layers], cell_end[layers], texel, texel_end;
  };
  Span span(int first, int last) const;
  void enter_layer(int layer, int row);
  void enter_height(int row);

  const DropsUniforms& u_;
  const StoredTexture<float>& cells_;
  const StoredTexture<Half>& height_;
  // Number of cells, and of texels of height, before this one that may be visible in the row.
  std::array<std::vector<std::int32_t>, layers> before_cell_;
  std::vector<std::int32_t> before_texel_;
  std::vector<Span> spans_;
  std::vector<std::uint16_t> texels_;
  int first_line_ = 0, last_line_ = -1;  // rows of height from which texels_ is made
};

}  // namespace rainref::screen_drops
