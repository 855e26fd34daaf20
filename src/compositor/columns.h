// Numbers of many positions or rays component by component, as lanes read them.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

namespace rainref::compositor {

/// Vectors in three arrays. T is double, or const double.
template <class T>
struct VecArraysOf {
  T* component[3];
  glm::dvec3 operator[](std::size_t i) const { return {component[0][i], component[1][i], component[2][i]}; }
  void put(std::size_t i, const glm::dvec3& v) const {
    for (int k = 0; k < 3; ++k) component[k][i] = v[k];
  }
  /// The vectors from the i-th on.
  VecArraysOf from(std::size_t i) const { return {{component[0] + i, component[1] + i, component[2] + i}}; }
  operator VecArraysOf<const T>() const { return {{component[0], component[1], component[2]}}; }
};
using VecArrays = VecArraysOf<const double>;
using VecArraysOut = VecArraysOf<double>;

/// Lanes of the widest vector of doubles. Arrays for lanes are readable and writable up to the next multiple of it; the extra values are
/// unused.
inline constexpr std::size_t most_lanes = 8;
inline constexpr std::size_t whole_lanes(std::size_t count) { return (count + most_lanes - 1) / most_lanes * most_lanes; }

/// `columns` arrays of doubles in one block.
template <int columns>
class Columns {
 public:
  /// Makes room for `count` numbers in each array. The contents are lost if that needs a new block.
  void make_room(std::size_t count) {
    if (count <= capacity_) return;
    capacity_ = whole_lanes(count);
    room_.assign(columns * stride(), 0.0);
  }
  double* operator[](int column) { return room_.data() + static_cast<std::size_t>(column) * stride(); }
  const double* operator[](int column) const { return room_.data() + static_cast<std::size_t>(column) * stride(); }
  /// Three columns as vectors.
  VecArraysOut vectors(int first) { return {{(*this)[first], (*this)[first + 1], (*this)[first + 2]}}; }
  VecArrays vectors(int first) const { return {{(*this)[first], (*this)[first + 1], (*this)[first + 2]}}; }

 private:
  // More than the capacity, so that the columns use different cache sets.
  std::size_t stride() const { return capacity_ + 2 * most_lanes; }
  std::size_t capacity_ = 0;
  std::vector<double> room_;
};

}  // namespace rainref::compositor
