// The puddle described to others.
#pragma once

#include "capture/pass_info.h"

namespace rainref::puddle {

/// Passes, buffers and GPU layouts of the puddle.
const capture::EffectInfo& effect_info();

}  // namespace rainref::puddle
