// A bounding volume hierarchy over the solids of the street.
#pragma once

#include <vector>

#include "night_street/shapes.h"

namespace rainref::night_street {

class Hierarchy {
 public:
  Hierarchy() = default;
  /// Splits at the minimum of the surface area heuristic, ties by axis and index: a fixed tree for a list of solids (Goldsmith and Salmon
  /// 1987; MacDonald and Booth 1990).
  explicit Hierarchy(const std::vector<Solid>& solids);

  /// Calls visit(solid index, farthest) for every solid whose box the ray crosses before `farthest`; visit may reduce `farthest` to cull
  /// everything behind.
  template <class Visit>
  void walk(const Ray& ray, double& farthest, const Visit& visit) const {
    if (nodes_.empty()) return;
    int stack[64], depth = 0;
    stack[depth++] = 0;
    double entry = 0;
    while (depth > 0) {
      const Node& node = nodes_[static_cast<std::size_t>(stack[--depth])];
      if (!crosses(node.box, ray, farthest, entry)) continue;
      if (node.count > 0) {
        for (int i = node.first; i < node.first + node.count; ++i) visit(order_[static_cast<std::size_t>(i)], farthest);
        continue;
      }
      const bool far_first = axis_of(ray.direction, node.axis) > 0;
      stack[depth++] = far_first ? node.second_child : node.first;
      stack[depth++] = far_first ? node.first : node.second_child;
    }
  }

 private:
  struct Node {
    Box box;
    int first = 0;  ///< leaf: first entry of order_; inner node: first child (low side of the split)
    int second_child = 0;
    int count = 0;  ///< number of solids of a leaf, 0 for an inner node
    int axis = 0;
  };
  static double axis_of(const Vec& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
  int build(std::vector<Box>& boxes, int begin, int end, int depth);
  std::vector<Node> nodes_;
  std::vector<int> order_;
};

}  // namespace rainref::night_street
