// What decoded textures take.
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/memory.h"

namespace rainref {

/// Floats of one level.
inline std::uint64_t texel_bytes(int width, int height, int channels) {
  return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * static_cast<std::uint64_t>(channels) * sizeof(float);
}

/// TextureData::build_mips of texels that are held. They move once, to where all levels have room: until then both lie in memory.
inline void hold_mips(MemoryPeak& memory, int width, int height, int channels) {
  std::uint64_t all = texel_bytes(width, height, channels);
  const std::uint64_t first = all;
  while (width > 1 || height > 1) {
    width = std::max(1, width / 2);
    height = std::max(1, height / 2);
    all += texel_bytes(width, height, channels);
  }
  memory.pass(all);
  memory.hold(all - first);
}

}  // namespace rainref
