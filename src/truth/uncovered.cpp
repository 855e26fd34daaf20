#include "truth/uncovered.h"

#include <algorithm>
#include <vector>

namespace rainref::truth {
namespace {

/// For each index the nearest one that `is_there`, the lower one of two; itself where none is.
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
