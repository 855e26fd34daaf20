#include "screen_drops/reach.h"

#include <algorithm>
#include <cmath>

namespace rainref::screen_drops {
namespace {

int floor_of(float x) { return static_cast<int>(std::floor(x)); }
float centre(int pixel) { return static_cast<float>(pixel) + 0.5f; }
/// The first of the two texels of a side that a bilinear lookup there takes, clamped.
int lower_texel(float u, int size) { return floor_of(std::clamp(u * static_cast<float>(size) - 0.5f, 0.0f, static_cast<float>(size - 1))); }

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
  for (int l = 0; l < layers; ++l) enter_layer(l, centre(row));
  if (u_.has_flow != 0) enter_height(centre(row));
}
void Reach::enter_layer(int l, float y) {
  const float qy = y * u_.cells_per_pixel[l] + u_.offset_y[l];
  const float place = qy - std::floor(qy);
  const int row = std::clamp(floor_of(qy) + u_.first_row[l], 0, cells_.height[0] - 1);
  const float* drop = cells_.texels + static_cast<std::ptrdiff_t>(row) * cells_.pitch[0] * 4;
  std::vector<std::int32_t>& before = before_cell_[static_cast<std::size_t>(l)];
  // Cover ends half a pixel beyond the base; a whole one leaves room for every rounding.
  for (int c = 0; c < cells_.width[0]; ++c, drop += 4) {
    const bool may_show = drop[2] > 0 && std::fabs(place - drop[1]) < drop[2] + u_.cells_per_pixel[l];
    before[static_cast<std::size_t>(c) + 1] = before[static_cast<std::size_t>(c)] + (may_show ? 1 : 0);
  }
}
void Reach::enter_height(float y) {
  const int lines = height_.height[0];
  const int first = lower_texel(y * u_.flow_pixel[1] - u_.flow_texel[1], lines), last = std::min(lower_texel(y * u_.flow_pixel[1] + u_.flow_texel[1], lines) + 1, lines - 1);
  if (first == first_line_ && last == last_line_) return;
  first_line_ = first;
  last_line_ = last;
  std::fill(texels_.begin(), texels_.end(), std::uint16_t{0});
  for (int line = first; line <= last; ++line) {
    const Half* texel = height_.texels + static_cast<std::ptrdiff_t>(line) * height_.pitch[0];
    for (std::size_t k = 0; k < texels_.size(); ++k) texels_[k] = static_cast<std::uint16_t>(texels_[k] | texel[k].bits);  // a height of 0 is stored as +0
  }
  for (std::size_t k = 0; k < texels_.size(); ++k) before_texel_[k + 1] = before_texel_[k] + (texels_[k] != 0 ? 1 : 0);
}

Reach::Span Reach::span(int first, int last) const {
  Span s{};
  // The pass rounds the same way, and floor, product and sum never fall where their argument rises: no cell between is missed.
  for (int l = 0; l < layers; ++l) {
    const auto cell = [&](int pixel) { return static_cast<std::uint32_t>(std::clamp(floor_of(centre(pixel) * u_.cells_per_pixel[l] + u_.offset_x[l]), 0, cells_.width[0] - 1)); };
    s.cell[l] = cell(first);
    s.cell_end[l] = cell(last) + 1;
  }
  if (u_.has_flow != 0) {
    const int columns = height_.width[0];
    s.texel = static_cast<std::uint32_t>(lower_texel(centre(first) * u_.flow_pixel[0] - u_.flow_texel[0], columns));
    s.texel_end = static_cast<std::uint32_t>(std::min(lower_texel(centre(last) * u_.flow_pixel[0] + u_.flow_texel[0], columns) + 1, columns - 1)) + 1;
  }
  return s;
}

}  // namespace rainref::screen_drops
