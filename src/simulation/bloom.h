// Light that a lens scatters around bright spots.
#pragma once

#include <cstdint>
#include <vector>

#include "rainref/executor.h"

namespace rainref::simulation {

/// Three floats per pixel, row by row.
struct LightImage {
  int width = 0, height = 0;
  std::vector<float> light;

  LightImage() = default;
  LightImage(int w, int h) : width(w), height(h), light(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  float* row(int y) { return light.data() + 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(y); }
  const float* row(int y) const { return light.data() + 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(y); }
};

/// Returns the mean of `levels` blurred copies; the k-th is about 2^k pixels wide. Each octave of radius holds the same amount of light, as
/// in a glare whose brightness falls with the square of the distance. Each level is made from the last by tents: 1 3 3 1 down, 1/4 3/4 up
/// (after Jorge Jimenez, "Next Generation Post Processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014). Edge pixels repeat outside. A
/// constant picture is unchanged. If the sides halve without remainder, the sum of all light is kept too. levels >= 1.
LightImage bloomed(LightImage picture, int levels, const parallel::Executor& executor);

/// Number of levels for a blur of `radius` times the height; at least 1.
int bloom_levels(int height, double radius);
/// Memory of bloomed [byte], without the picture.
std::uint64_t bloom_bytes(int width, int height);

}  // namespace rainref::simulation
