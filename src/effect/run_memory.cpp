#include "effect/run_memory.h"

namespace rainref::effect {

void add_pictures(RunMemory& m, bool png, bool exr) {
  if (png) m.peak.pass(m.pixels() / m.samples * (4 + 3));
  if (exr) m.peak.pass(m.pixels() * (m.exr_images + m.exr_texel + m.exr_texel * 3 / 2));
}

void add_captures(RunMemory& m) { m.peak.pass(m.peak.held()); }

void require_memory(const RunMemory& memory) { rainref::require_memory(memory.subject, memory.peak.peak()); }

}  // namespace rainref::effect
