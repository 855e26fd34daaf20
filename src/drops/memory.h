// What the water on a glass takes.
#pragma once

#include "base/memory.h"
#include "drops/settings.h"

namespace rainref::drops {

/// WetGlass and what its passes work with, with a film of columns x rows texels, while there are at most `live` drops, which may lean.
MemoryPeak memory(const Settings& settings, int columns, int rows, std::int64_t live, bool lean);

}  // namespace rainref::drops
