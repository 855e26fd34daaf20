// What the host gives wipe_drops, described to others.
#pragma once

#include <vector>

#include "capture/pass_info.h"

namespace rainref::windshield {

/// The buffer wipers, from the host. Drops, film and glass_frame belong to the room drops.
std::vector<capture::BufferInfo> wiper_buffers();
/// The record Wiper.
std::vector<scene::UniformBlock> wiper_records();

}  // namespace rainref::windshield
