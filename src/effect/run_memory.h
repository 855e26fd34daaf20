// What a run takes at its peak, so that one that does not fit is refused before anything is made.
#pragma once

#include <string>

#include "base/memory.h"
#include "rainref/image.h"
#include "scene/config.h"

namespace rainref::effect {

/// Memory of a simulation: pictures made for it, the effect, what is traced of it. What it holds at the end, it holds between frames.
/// Pictures that are read from files count when they are read.
struct RunMemory {
  std::string subject;  ///< "run.size 1280x720": what in the scene asks for it
  MemoryPeak peak;
  int width, height;                    ///< that passes run at
  std::uint64_t exr_images, exr_texel;  ///< of an EXR picture, bytes a pixel: images turned over, and their channels side by side
  std::uint64_t samples = 1;            ///< of the passes in a pixel of the picture: run.supersample squared

  std::uint64_t pixels() const { return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height); }
};
/// An image of the picture's size.
inline std::uint64_t image_bytes(const RunMemory& m, Format format) { return Image::memory_bytes(format, m.width, m.height); }
/// Whether the scene names a file there.
inline bool is_named(const scene::Config& config, const char* key) { return !config.text(key).empty(); }

/// Adds what writing of pictures takes after a frame. Files are taken to be compressed to half.
inline void add_pictures(RunMemory& m, bool png, bool exr) {
  if (png) m.peak.pass(m.pixels() / m.samples * (4 + 3));
  if (exr) m.peak.pass(m.pixels() * (m.exr_images + m.exr_texel + m.exr_texel * 3 / 2));
}
/// Adds the copies that a pack or a capture makes of what passes take and give.
inline void add_captures(RunMemory& m) { m.peak.pass(m.peak.held()); }
/// Throws Error(usage) where it does not fit.
inline void require_memory(const RunMemory& memory) { rainref::require_memory(memory.subject, memory.peak.peak()); }

}  // namespace rainref::effect
