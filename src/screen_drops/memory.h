// What screen_drops takes.
#pragma once

#include "base/memory.h"
#include "rainref/screen_drops.h"

namespace rainref::screen_drops {

/// Of the constructor and of frames, with noise of noise_size texels a side. The inputs are their owner's. flow: as the effect takes it,
/// after so many seconds of rain.
MemoryPeak memory(const Settings& settings, const FlowSettings* flow = nullptr, double seconds = 0);

}  // namespace rainref::screen_drops
