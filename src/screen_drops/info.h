// screen_drops described to others.
#pragma once

#include "capture/pass_info.h"

namespace rainref::screen_drops {

/// Passes, buffers and GPU layouts of screen_drops.
const capture::EffectInfo& effect_info();

}  // namespace rainref::screen_drops
