// windshield_frame and wipe_drops described to others: the windshield's effect_info takes these pieces.
#pragma once

#include <vector>

#include "capture/pass_info.h"

namespace rainref::windshield {

capture::PassInfo windshield_frame_info();
/// `from`: the pass that writes the drops before this one.
capture::PassInfo wipe_drops_info(const char* from);
/// The buffer wipers, from the host. Drops, film and glass_frame belong to the room drops.
std::vector<capture::BufferInfo> wiper_buffers();
/// The record Wiper.
std::vector<scene::UniformBlock> wiper_records();

}  // namespace rainref::windshield
