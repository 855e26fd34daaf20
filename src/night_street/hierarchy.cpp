#include "night_street/hierarchy.h"

#include <algorithm>
#include <numeric>

namespace rainref::night_street {

namespace {

constexpr int leaf_size = 2;

void grow(Box& box, const Box& by) {
  box.low = {min_of(box.low.x, by.low.x), min_of(box.low.y, by.low.y), min_of(box.low.z, by.low.z)};
  box.high = {max_of(box.high.x, by.high.x), max_of(box.high.y, by.high.y), max_of(box.high.z, by.high.z)};
}

}  // namespace

Hierarchy::Hierarchy(const std::vector<Solid>& solids) {
  std::vector<Box> boxes;
  for (const Solid& solid : solids) {
    Box box = solid.bounds();
    // A skin far above rounding, so that a box never culls a solid that the exact test would meet.
    const Vec skin{1e-6, 1e-6, 1e-6};
    boxes.push_back({box.low - skin, box.high + skin});
  }
  order_.resize(solids.size());
  std::iota(order_.begin(), order_.end(), 0);
  if (!solids.empty()) build(boxes, 0, static_cast<int>(solids.size()));
}

int Hierarchy::build(std::vector<Box>& boxes, int begin, int end) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  node.box = boxes[static_cast<std::size_t>(order_[static_cast<std::size_t>(begin)])];
  for (int i = begin + 1; i < end; ++i)
    grow(node.box, boxes[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])]);
  if (end - begin <= leaf_size) {
    node.first = begin;
    node.count = end - begin;
  } else {
    const Vec extent = node.box.high - node.box.low;
    node.axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const auto centre = [&](int i) {
      const Box& box = boxes[static_cast<std::size_t>(i)];
      return axis_of(box.low, node.axis) + axis_of(box.high, node.axis);
    };
    // A total order: equal centres are ordered by index, so every library sorts alike.
    std::sort(order_.begin() + begin, order_.begin() + end, [&](int a, int b) {
      const double ca = centre(a), cb = centre(b);
      return ca < cb || (ca == cb && a < b);
    });
    const int middle = begin + (end - begin) / 2;
    node.first = build(boxes, begin, middle);
    node.second_child = build(boxes, middle, end);
  }
  nodes_[static_cast<std::size_t>(index)] = node;
  return index;
}

}  // namespace rainref::night_street
