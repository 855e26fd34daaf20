// Which water may show in a stretch of a row, so that drops need not ask for the rest: most of a window is dry, and most of a
// layer's cells are empty.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "image/stored_texture.h"
#include "screen_drops/uniforms.h"

namespace rainref::screen_drops {

/// Where it answers no, drops_corrected would find no cover: it never errs that way. It may answer yes to a dry stretch.
class Reach {
 public:
  /// For rows of `columns` pixels in stretches of `stretch`; cells, height: as drops takes them, which must outlive it.
  Reach(const DropsUniforms& uniforms, const StoredTexture<float>& cells, const StoredTexture<Half>& height, int columns, int stretch);
  void enter_row(int row);
  /// Of a stretch of that row.
  Wanted of(int stretch) const {
    const Span& s = spans_[static_cast<std::size_t>(stretch)];
    Wanted wanted = u_.has_flow != 0 && before_texel_[s.texel_end] != before_texel_[s.texel] ? wanted_flow : 0;
    for (std::size_t l = 0; l < layers; ++l)
      wanted |= static_cast<Wanted>(before_cell_[l][s.cell_end[l]] != before_cell_[l][s.cell[l]]) << l;
    return wanted;
  }

 private:
  /// The cells and texels under a stretch; the ends are not among them.
  struct Span {
    std::uint32_t cell[layers], cell_end[layers], texel, texel_end;
  };
  Span span(int first, int last) const;
  void enter_layer(int layer, int row);
  void enter_height(int row);

  const DropsUniforms& u_;
  const StoredTexture<float>& cells_;
  const StoredTexture<Half>& height_;
  // Of the cells, and of the texels of height, how many before this one may show in the row.
  std::array<std::vector<std::int32_t>, layers> before_cell_;
  std::vector<std::int32_t> before_texel_;
  std::vector<Span> spans_;
  std::vector<std::uint16_t> texels_;
  int first_line_ = 0, last_line_ = -1;  // of height, that texels_ is made from
};

}  // namespace rainref::screen_drops
