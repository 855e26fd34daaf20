// From a pack's manifest to the structures of pack_read.h.
#pragma once

#include "capture/json_field.h"
#include "capture/pack_read.h"

namespace rainref::capture {

/// A uniform block or a record as a manifest has it; the members' units and sentences may be missing.
scene::UniformBlock read_uniform_block(const JsonField& from);
/// Fills a pack from its manifest. Throws Error(port_files) for the first thing that is not as docs/packs.md says.
void read_manifest(const JsonField& manifest, Pack& pack);

}  // namespace rainref::capture
