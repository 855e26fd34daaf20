// Reads a pack's manifest into the structures of pack_read.h.
#pragma once

#include "capture/json_field.h"
#include "capture/pack_read.h"

namespace rainref::capture {

/// Reads a uniform block or record; the members' units and sentences may be missing.
scene::UniformBlock read_uniform_block(const JsonField& from);
/// Fills a pack from its manifest. Throws Error(port_files) for the first violation of docs/packs.md.
void read_manifest(const JsonField& manifest, Pack& pack);

}  // namespace rainref::capture
