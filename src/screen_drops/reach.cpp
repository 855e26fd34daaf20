#include "screen_drops/reach.h"

#include <algorithm>
#include <cstdlib>

#include "screen_drops/scalar.h"

namespace rainref::screen_drops {
namespace {

using Single = scalar::Scalar<float>;

int floor_of(Single x) { return to_int(floor(x)).i; }
Single centre(int pixel) { return Single(static_cast<float>(pixel) + 0.5f); }
/// The first of the two texels along a side that a bilinear lookup reads there.
int lower_texel(Single u, int size) { return floor_of(scalar::texel_coordinate(Address::clamp, u, Single(static_cast<float>(size)))); }

}  // namespace

Reach::Reach(const DropsUniforms& u, const StoredTexture<float>& cells, const StoredTexture<Half>& height, int columns, int stretch)
    : u_(u), cells_(cells), height_(height) {
  for (auto& before : before_cell_) before.resize(static_cast<std::size_t>(cells.width[0]) + 1);
  if (u.has_flow != 0) {
    texels_.resize(static_cast<std::size_t>(height.width[0]));
    before_texel_.resize(texels_.size() + 1);
  }
  for (int first = 0; first < columns; first += stretch) spans_.push_back(span(first, first + stretch - 1));
}

void Reach::enter_row(int row) {
  for (int l = 0; l < layers; ++l) enter_layer(l, row);
  if (u_.has_flow != 0) enter_height(row);
}
void Reach::enter_layer(int l, int row) {
  const Single qy = scalar::cell_place(u_, l, centre(0), centre(row)).b;
  const float place = fract(qy).v;
  const int line = std::clamp(floor_of(qy) + u_.first_row[l], 0, cells_.height[0] - 1);
  const float* drop = cells_.texels + static_cast<std::ptrdiff_t>(line) * cells_.pitch[0] * 4;
  std::vector<std::int32_t>& before = before_cell_[static_cast<std::size_t>(l)];
  // Cover ends half a pixel beyond the base; a whole pixel leaves room for every rounding.
  for (int c = 0; c < cells_.width[0]; ++c, drop += 4) {
    const bool may_show = drop[2] > 0 && std::abs(place - drop[1]) < drop[2] + u_.cells_per_pixel[l];
    before[static_cast<std::size_t>(c) + 1] = before[static_cast<std::size_t>(c)] + (may_show ? 1 : 0);
  }
}
void Reach::enter_height(int row) {
  const int lines = height_.height[0];
  const Single y = scalar::flow_place(u_, centre(0), centre(row)).b, texel_height(u_.flow_texel[1]);
  const int first = lower_texel(y - texel_height, lines), last = std::min(lower_texel(y + texel_height, lines) + 1, lines - 1);
  if (first == first_line_ && last == last_line_) return;
  first_line_ = first;
  last_line_ = last;
  std::fill(texels_.begin(), texels_.end(), std::uint16_t{0});
  for (int line = first; line <= last; ++line) {
    const Half* texel = height_.texels + static_cast<std::ptrdiff_t>(line) * height_.pitch[0];
    for (std::size_t k = 0; k < texels_.size(); ++k)
      texels_[k] = static_cast<std::uint16_t>(texels_[k] | texel[k].bits);  // a height of 0 is stored as +0
  }
  for (std::size_t k = 0; k < texels_.size(); ++k) before_texel_[k + 1] = before_texel_[k] + (texels_[k] != 0 ? 1 : 0);
}

Reach::Span Reach::span(int first, int last) const {
  Span s{};
  // The positions are the pass's own, and floor, product and sum are monotone, so no cell between is missed.
  for (int l = 0; l < layers; ++l) {
    const auto cell = [&](int pixel) {
      return static_cast<std::uint32_t>(
          std::clamp(floor_of(scalar::cell_place(u_, l, centre(pixel), centre(0)).a), 0, cells_.width[0] - 1));
    };
    s.cell[l] = cell(first);
    s.cell_end[l] = cell(last) + 1;
  }
  if (u_.has_flow != 0) {
    const int columns = height_.width[0];
    const Single texel_width(u_.flow_texel[0]);
    const auto place = [&](int pixel) { return scalar::flow_place(u_, centre(pixel), centre(0)).a; };
    s.texel = static_cast<std::uint32_t>(lower_texel(place(first) - texel_width, columns));
    s.texel_end = static_cast<std::uint32_t>(std::min(lower_texel(place(last) + texel_width, columns) + 1, columns - 1)) + 1;
  }
  return s;
}

}  // namespace rainref::screen_drops
