// The peak memory of a run, so that a run that does not fit is refused before any work.
#pragma once

#include <string>

#include "base/memory.h"
#include "rainref/image.h"
#include "scene/config.h"

namespace rainref::effect {

/// Memory of a simulation: pictures generated for it, the effect, and traced pictures. What it holds at the end it holds between frames.
/// Pictures from files count when they are read.
struct RunMemory {
  std::string subject;  ///< "run.size 1280x720": the setting that determines it
  MemoryPeak peak;
  int width, height;                    ///< size at which the passes run
  std::uint64_t exr_images, exr_texel;  ///< for an EXR picture, bytes per pixel: flipped images, and their interleaved channels
  std::uint64_t samples = 1;            ///< samples of the passes per pixel of the picture: run.supersample squared

  std::uint64_t pixels() const { return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height); }
};
/// An image of the picture's size.
inline std::uint64_t image_bytes(const RunMemory& m, Format format) { return Image::memory_bytes(format, m.width, m.height); }
/// True if the scene names a file for this key.
inline bool is_named(const scene::Config& config, const char* key) { return !config.text(key).empty(); }

/// Adds the memory for writing pictures after a frame. Files are assumed to be compressed to half their size.
inline void add_pictures(RunMemory& m, bool png, bool exr) {
  if (png) m.peak.pass(m.pixels() / m.samples * (4 + 3));
  if (exr) m.peak.pass(m.pixels() * (m.exr_images + m.exr_texel + m.exr_texel * 3 / 2));
}
/// Adds the copies of inputs and outputs that a pack or a capture makes.
inline void add_captures(RunMemory& m) { m.peak.pass(m.peak.held()); }
/// Throws Error(usage) if the run does not fit.
inline void require_memory(const RunMemory& memory) { rainref::require_memory(memory.subject, memory.peak.peak()); }

}  // namespace rainref::effect
