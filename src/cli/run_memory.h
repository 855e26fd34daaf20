// What a run takes at its peak, so that one that does not fit is refused before anything is made.
#pragma once

#include <string>

#include "base/memory.h"
#include "scene/config.h"

namespace rainref::cli {

/// Memory of a simulation: pictures made for it, the effect, what is traced of it. What it holds at the end, it holds between frames.
/// Pictures that are read from files count when they are read.
struct RunMemory {
  std::string subject;  ///< "run.size 1280x720": what in the scene asks for it
  MemoryPeak peak;
  std::size_t pixels;
  std::size_t exr_images, exr_texel;  ///< of an EXR picture, bytes a pixel: images turned over, and their channels side by side
};
/// Adds what writing of pictures takes after a frame. Files are taken to be compressed to half.
void add_pictures(RunMemory& memory, bool png, bool exr);
/// Adds the copies that a pack or a capture makes of what passes take and give.
void add_captures(RunMemory& memory);

RunMemory puddle_memory(const scene::Config& config);
RunMemory edge_splash_memory(const scene::Config& config);
RunMemory screen_drops_memory(const scene::Config& config);
RunMemory rainy_glass_memory(const scene::Config& config);
RunMemory windshield_memory(const scene::Config& config);

/// Throws Error(usage) where it does not fit.
void require_memory(const RunMemory& memory);

}  // namespace rainref::cli
