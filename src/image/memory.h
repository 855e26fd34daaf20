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

/// TextureData::build_mips of texels that are held. They move once, when level 1 is added: until then both lie in memory.
inline void hold_mips(MemoryPeak& memory, int width, int height, int channels) {
  const std::uint64_t first = texel_bytes(width, height, channels);
  memory.pass(first + texel_bytes(std::max(1, width / 2), std::max(1, height / 2), channels));
  while (width > 1 || height > 1) {
    width = std::max(1, width / 2);
    height = std::max(1, height / 2);
    memory.hold(texel_bytes(width, height, channels));
  }
}

}  // namespace rainref
