// windshield_frame and wipe_drops described to others: the windshield's effect_info takes these pieces.
#pragma once

#include <vector>

#include "capture/pass_info.h"

namespace rainref::windshield {

capture::PassInfo windshield_frame_info();
/// `from`: the pass that writes the drops before this one.
capture::PassInfo wipe_drops_info(const char* from);
/// The buffers wipers (from the host) and glass_frame. Drops and film belong to the room drops.
std::vector<capture::BufferInfo> motion_buffers();
/// The records Wiper and GlassFrame.
std::vector<scene::UniformBlock> motion_records();

}  // namespace rainref::windshield
