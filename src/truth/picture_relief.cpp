#include "truth/picture_relief.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compositor/optics.h"

namespace rainref::truth {

PictureRelief::PictureRelief(const scene::Camera& camera, double half_width, double half_height, const Image& colour, const Image& depth)
    : eye_(camera.position),
      basis_(camera.basis()),
      scale_{0.5 / half_width, 0.5 / half_height},
      columns_(colour.width()),
      rows_(colour.height()),
      colour_(colour, Address::clamp, Address::clamp),
      depth_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
  for (int y = 0; y < rows_; ++y)
    std::copy_n(depth.row<float>(y), columns_, depth_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_));
}

Vec PictureRelief::colour_at(const Place& at) const {
  using compositor::scalar::Number;
  const auto s = compositor::scalar::sample_bilinear<0, 3, Number>(fixed_texture<Address::clamp, Address::clamp, 4>(colour_.view()),
                                                                   Number(at.x / columns_), Number(at.y / rows_));
  return {s[0].v, s[1].v, s[2].v};
}

double PictureRelief::depth_at(const Place& at) const {
  const int x = static_cast<int>(std::clamp(std::floor(at.x), 0.0, columns_ - 1.0)),
            y = static_cast<int>(std::clamp(std::floor(at.y), 0.0, rows_ - 1.0));
  return depth_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x)];
}

// In the picture the ray is a straight line from the projection of its origin to its vanishing point. With w = (origin's depth) / (depth
// there), from 1 to 0, it is end + w (begin - end). It has hit a plate of depth D if w D is at most the origin's depth.
PictureRelief::Sight PictureRelief::look(const Vec& origin, const Vec& direction) const {
  const Vec from_eye = origin - eye_;
  const double depth = dot(from_eye, basis_.forward), ahead = dot(direction, basis_.forward), by = std::max(ahead, most_turn_cosine);
  const Place end = place(dot(direction, basis_.right) / by, dot(direction, basis_.up) / by);
  if (!(ahead >= most_turn_cosine && depth > 0)) return {std::numeric_limits<double>::infinity(), colour_at(end)};
  const Place begin = place(dot(from_eye, basis_.right) / depth, dot(from_eye, basis_.up) / depth);
  const Place way{begin.x - end.x, begin.y - end.y};
  const int steps = 1 + static_cast<int>(std::max(std::abs(way.x), std::abs(way.y)));  // each of less than a texel
  const auto at = [&](double w) { return Place{end.x + w * way.x, end.y + w * way.y}; };
  double before = 1, met = 1;
  for (int k = 0; k <= steps; ++k) {
    const double w = static_cast<double>(steps - k) / steps, plate = depth_at(at(w));
    if (w * plate <= depth) {
      met = plate > 0 ? std::min(depth / plate, before) : before;
      break;
    }
    before = w;
  }
  return {(depth / met - depth) / ahead, colour_at(at(met))};
}

namespace {

/// For each index the nearest one with `is_there`, the lower one of two; itself if there is none.
std::vector<int> nearest(const std::vector<bool>& is_there) {
  const int count = static_cast<int>(is_there.size());
  std::vector<int> out(is_there.size());
  for (int i = 0; i < count; ++i) {
    const auto at = [&](int k) { return k >= 0 && k < count && is_there[static_cast<std::size_t>(k)]; };
    int off = 0;
    while (off < count && !at(i - off) && !at(i + off)) ++off;
    out[static_cast<std::size_t>(i)] = off == count ? i : at(i - off) ? i - off : i + off;
  }
  return out;
}

}  // namespace

Uncovered uncovered(const Image& colour, const Image& depth, const Image& surface) {
  const int width = colour.width(), height = colour.height();
  std::vector<std::vector<bool>> is_behind;
  std::vector<bool> has_some;
  for (int y = 0; y < height; ++y) {
    std::vector<bool>& row = is_behind.emplace_back();
    for (int x = 0; x < width; ++x) row.push_back(depth.row<float>(y)[x] > surface.row<float>(y)[4 * x + 2]);
    has_some.push_back(std::find(row.begin(), row.end(), true) != row.end());
  }
  const std::vector<int> rows = nearest(has_some);
  Uncovered out{Image(Format::rgba32f, width, height), Image(Format::r32f, width, height)};
  for (int y = 0; y < height; ++y) {
    const int from = rows[static_cast<std::size_t>(y)];
    const std::vector<int> columns = nearest(is_behind[static_cast<std::size_t>(from)]);
    for (int x = 0; x < width; ++x) {
      const int column = columns[static_cast<std::size_t>(x)];
      std::copy_n(colour.row<float>(from) + 4 * column, 4, out.colour.row<float>(y) + 4 * x);
      out.depth.row<float>(y)[x] = depth.row<float>(from)[column];
    }
  }
  return out;
}

}  // namespace rainref::truth
