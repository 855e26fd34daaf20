// What rainy_glass takes.
#pragma once

#include <array>

#include "base/memory.h"
#include "rainref/rainy_glass.h"

namespace rainref::rainy_glass {

/// Columns and rows of the pictures whose size is their own.
struct PictureSizes {
  std::array<int, 2> probe{1024, 512};
  std::array<int, 2> raindrops{0, 0}, rivulets{0, 0};  ///< 0: baked
};
PictureSizes sizes_of(const Surroundings& surroundings);

/// Of the constructor and of frames. The pictures themselves are their owner's.
MemoryPeak memory(const Settings& settings, const PictureSizes& sizes = {});
/// Throws Error(usage) where it does not fit.
void check_memory(const Settings& settings, const PictureSizes& sizes = {});

}  // namespace rainref::rainy_glass
