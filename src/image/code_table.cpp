#include "image/code_table.h"

#include <utility>

namespace rainref {
namespace {

constexpr int side = 256, texels_for_all = (65536 + 2) / 3, lines = (texels_for_all + side - 1) / side;

/// Calls each(half bits, column, line, channel) for the position where the pass gets each half.
template <class Each>
void for_every_half(const Each& each) {
  for (std::uint32_t bits = 0; bits < 65536; ++bits) {
    const int texel = static_cast<int>(bits / 3);
    each(bits, texel % side, texel / side, static_cast<int>(bits % 3));
  }
}

}  // namespace

CodeTable::CodeTable(int width, int height, Pass pass) : pass_(std::move(pass)) {
  if (static_cast<std::int64_t>(width) * height < texels_for_all) return;
  code_.resize(65536);
  Image colour(Format::rgba16f, side, lines), picture(Format::rgba8, side, lines);
  for_every_half(
      [&](std::uint32_t bits, int x, int y, int channel) { colour.row<Half>(y)[4 * x + channel] = {static_cast<std::uint16_t>(bits)}; });
  pass_(colour, picture, 0, lines);
  for_every_half([&](std::uint32_t bits, int x, int y, int channel) { code_[bits] = picture.row<Unorm8>(y)[4 * x + channel].code; });
}

void CodeTable::rows(const Image& colour, Image& picture, int y0, int y1) const {
  if (code_.empty()) return pass_(colour, picture, y0, y1);
  for (int y = y0; y < y1; ++y) {
    const Half* in = colour.row<Half>(y);
    Unorm8* out = picture.row<Unorm8>(y);
    for (int x = 0; x < colour.width(); ++x, in += 4, out += 4) {
      out[0].code = code_[in[0].bits];
      out[1].code = code_[in[1].bits];
      out[2].code = code_[in[2].bits];
      out[3].code = 255;
    }
  }
}

}  // namespace rainref
