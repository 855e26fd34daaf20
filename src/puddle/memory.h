// What a puddle takes.
#pragma once

#include <array>

#include "base/memory.h"
#include "rainref/puddle.h"

namespace rainref::puddle {

/// Columns and rows of the pictures that a puddle is made with.
struct PictureSizes {
  std::array<int, 2> environment{1024, 512};
  bool has_float_environment = false;  ///< its texels are floats, which are read where they lie
  std::array<int, 2> ground{0, 0};     ///< 0: asphalt made here
  std::array<int, 2> shelter{0, 0};
};
PictureSizes sizes_of(const Surroundings& surroundings);

/// Of the constructor and of frames. The pictures themselves are their owner's.
MemoryPeak memory(const Settings& settings, const PictureSizes& sizes = {});
/// Throws Error(usage) where it does not fit.
void check_memory(const Settings& settings, const PictureSizes& sizes = {});

}  // namespace rainref::puddle
