// Memory of decoded textures.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "base/memory.h"

namespace rainref {

/// Bytes of the floats of one level.
inline std::uint64_t texel_bytes(int width, int height, int channels) {
  return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * static_cast<std::uint64_t>(channels) * sizeof(float);
}

/// Bytes of the levels after the first: down to one texel, or until there are `levels` in all.
inline std::uint64_t mip_bytes(int width, int height, int channels, int levels = std::numeric_limits<int>::max()) {
  std::uint64_t bytes = 0;
  for (; levels > 1 && (width > 1 || height > 1); --levels) {
    width = std::max(1, width / 2);
    height = std::max(1, height / 2);
    bytes += texel_bytes(width, height, channels);
  }
  return bytes;
}

/// Adds TextureData::build_mips for texels that are held. Without spare room they are copied once, and both copies exist for a time.
inline void hold_mips(MemoryPeak& memory, int width, int height, int channels) {
  const std::uint64_t more = mip_bytes(width, height, channels);
  memory.pass(texel_bytes(width, height, channels) + more);
  memory.hold(more);
}

}  // namespace rainref
