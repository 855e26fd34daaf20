// Memory of rendering a scenery.
#pragma once

#include "base/memory.h"
#include "rainref/image.h"

namespace rainref::scene {

/// Bytes of one ray per texel, before neighbours are compared: radiance, tone, object, ground.
inline std::uint64_t centres_bytes(int width, int height) {
  return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * 40;  // size of Centre in night_street/antialias.cpp
}

/// Memory of Scenery::view. Holds colour and depth.
inline MemoryPeak view_memory(int width, int height) {
  MemoryPeak memory;
  memory.hold(Image::memory_bytes(Format::r32f, width, height) + Image::memory_bytes(Format::rgba32f, width, height));
  memory.pass(centres_bytes(width, height));
  return memory;
}
/// Memory of Scenery::panorama. Holds the picture.
inline MemoryPeak panorama_memory(int width, int height) {
  MemoryPeak memory;
  memory.hold(Image::memory_bytes(Format::rgba32f, width, height));
  memory.pass(centres_bytes(width, height));
  return memory;
}

}  // namespace rainref::scene
