// What edge_splash takes.
#pragma once

#include "base/memory.h"
#include "rainref/edge_splash.h"

namespace rainref::edge_splash {

/// Of the constructor and of frames, with a noise map of noise_side texels a side. The inputs are their owner's.
MemoryPeak memory(const Settings& settings, int noise_side = 256);

}  // namespace rainref::edge_splash
