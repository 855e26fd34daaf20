// The operations of one invocation of a pass text, in order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "math/places.h"

namespace rainref::perturbed {

/// How often each shape was met, and where last. A hash table that is emptied in constant time: this is done before each invocation.
class ShapeCounts {
 public:
  /// Counts a node of a shape; returns the last node of this shape before; -1: none.
  std::int32_t add(std::uint32_t shape, std::int32_t node);
  /// The count of a shape; 0 if it was not met.
  std::int32_t at(std::uint32_t shape) const;
  /// The last node of a shape; -1: none.
  std::int32_t last(std::uint32_t shape) const;
  void clear();

 private:
  struct Entry {
    std::uint32_t shape, round;
    std::int32_t count, last;
  };
  /// Where a shape stands, or would stand.
  std::size_t place_of(std::uint32_t shape) const;

  std::vector<Entry> entries_ = std::vector<Entry>(64);  ///< a power of two, at most half full
  std::uint32_t round_ = 1;                              ///< entries of other rounds are empty
  std::size_t used_ = 0;
};

/// The operations of an invocation, in order.
struct Trace {
  struct Node {
    Op op = Op::constant;
    float value = 0;
    std::uint32_t shape = 0;
    std::int32_t occurrence = 0;
    std::array<std::int32_t, 4> of{-1, -1, -1, -1};  ///< nodes; -1: none, or a number of unknown origin
    std::array<float, 4> with{};                     ///< the operands themselves, after substitutions
    std::array<std::uint32_t, 2> shallow{};          ///< shapes one and two operations deep
    std::uint32_t sequence = 0;                      ///< hash of the last operations up to it
    std::int32_t alike = -1;                         ///< the last node of this shape before it; -1: none
  };
  std::vector<Node> nodes;
  ShapeCounts met;  ///< so far

  void clear() {
    nodes.clear();
    met.clear();
  }
  /// Appends a node, sets its `occurrence` and `alike`, and returns it.
  Node& add(Op op, float value, std::uint32_t shape);
  /// The value of the shape met `back` times ago (1: last) among the first `before` nodes; null: not so often.
  const float* value_met(std::uint32_t shape, std::int32_t back, std::size_t before) const;
};

}  // namespace rainref::perturbed
