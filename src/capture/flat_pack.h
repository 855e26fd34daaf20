// A second form of a pack: raw bytes and one small JSON file, for engines that cannot read NPY (docs/packs.md).
#pragma once

#include <filesystem>

#include "capture/pack_read.h"
#include "capture/pack_write.h"

namespace rainref::capture {

inline constexpr char flat_name[] = "flat.json";

/// Writes inputs and uniform blocks of every case as .bin files, rows without padding and mip levels one after the other, and flat.json,
/// which names them and describes the outputs. The expected values of outputs are left out: a port writes its own. An array that several
/// cases take is written once. An older flat pack in the folder is replaced; any other folder that is not empty is Error(io). Throws as
/// Pack::read does, and Error(usage) for a pack without inputs.
PackWriter::Total write_flat(const Pack& pack, const std::filesystem::path& folder);

}  // namespace rainref::capture
