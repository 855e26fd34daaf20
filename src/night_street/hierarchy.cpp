#include "night_street/hierarchy.h"

#include <algorithm>
#include <numeric>

namespace rainref::night_street {

namespace {

constexpr int leaf_size = 2;
constexpr int deepest_uneven = 32;  // beyond, halves: a walk has room for 64 levels

void grow(Box& box, const Box& by) {
  box.low = {min_of(box.low.x, by.low.x), min_of(box.low.y, by.low.y), min_of(box.low.z, by.low.z)};
  box.high = {max_of(box.high.x, by.high.x), max_of(box.high.y, by.high.y), max_of(box.high.z, by.high.z)};
}

double area(const Box& box) {
  const Vec e = box.high - box.low;
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

}  // namespace

Hierarchy::Hierarchy(const std::vector<Solid>& solids) {
  std::vector<Box> boxes;
  for (const Solid& solid : solids) {
    Box box = solid.bounds();
    // A margin far above rounding, so that a box never culls a solid that the exact test would hit.
    const Vec skin{1e-6, 1e-6, 1e-6};
    boxes.push_back({box.low - skin, box.high + skin});
  }
  order_.resize(solids.size());
  std::iota(order_.begin(), order_.end(), 0);
  if (!solids.empty()) build(boxes, 0, static_cast<int>(solids.size()), 0);
}

int Hierarchy::build(std::vector<Box>& boxes, int begin, int end, int depth) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  node.box = boxes[static_cast<std::size_t>(order_[static_cast<std::size_t>(begin)])];
  for (int i = begin + 1; i < end; ++i) grow(node.box, boxes[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])]);
  if (end - begin <= leaf_size) {
    node.first = begin;
    node.count = end - begin;
  } else {
    // A total order: equal centres are ordered by index, so every library sorts alike.
    const auto sort_along = [&](int axis) {
      const auto centre = [&](int i) {
        const Box& box = boxes[static_cast<std::size_t>(i)];
        return axis_of(box.low, axis) + axis_of(box.high, axis);
      };
      std::sort(order_.begin() + begin, order_.begin() + end, [&](int a, int b) {
        const double ca = centre(a), cb = centre(b);
        return ca < cb || (ca == cb && a < b);
      });
    };
    const auto box_of = [&](int i) -> const Box& { return boxes[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])]; };
    double least = 1e300;
    int middle = begin + 1;
    std::vector<double> left(static_cast<std::size_t>(end - begin));
    for (int axis = 0; axis < 3; ++axis) {
      sort_along(axis);
      Box grown = box_of(begin);
      for (int i = begin; i < end; ++i) {
        grow(grown, box_of(i));
        left[static_cast<std::size_t>(i - begin)] = area(grown) * (i + 1 - begin);
      }
      grown = box_of(end - 1);
      for (int i = end - 1; i > begin; --i) {
        grow(grown, box_of(i));
        const double cost = left[static_cast<std::size_t>(i - 1 - begin)] + area(grown) * (end - i);
        if (cost < least) {
          least = cost;
          middle = i;
          node.axis = axis;
        }
      }
    }
    sort_along(node.axis);
    if (depth >= deepest_uneven) middle = begin + (end - begin) / 2;
    node.first = build(boxes, begin, middle, depth + 1);
    node.second_child = build(boxes, middle, end, depth + 1);
  }
  nodes_[static_cast<std::size_t>(index)] = node;
  return index;
}

}  // namespace rainref::night_street
