// Light that a lens scatters around what is bright.
#pragma once

#include <cstdint>
#include <vector>

#include "rainref/executor.h"

namespace rainref::simulation {

/// Three floats a pixel, row after row.
struct LightImage {
  int width = 0, height = 0;
  std::vector<float> light;

  LightImage() = default;
  LightImage(int w, int h) : width(w), height(h), light(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  float* row(int y) { return light.data() + 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(y); }
  const float* row(int y) const { return light.data() + 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(y); }
};

/// The mean of `levels` blurred copies of it, the k-th about 2^k pixels wide: each octave of radius holds as much light, as in a glare
/// whose brightness falls with the square of the distance. Down by tents 1 3 3 1, up by tents 1/4 3/4, from level to level (after Jorge
/// Jimenez, "Next Generation Post Processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014). Beyond an edge the edge repeats. A level
/// picture stays; where sides halve without rest the sum of all light stays too. levels from 1.
LightImage bloomed(LightImage picture, int levels, const parallel::Executor& executor);

/// Levels up to a width of `radius` times the height; at least 1.
int bloom_levels(int height, double radius);
/// What bloomed holds at a time, without the picture.
std::uint64_t bloom_bytes(int width, int height);

}  // namespace rainref::simulation
