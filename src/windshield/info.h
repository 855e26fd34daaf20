// The windshield described to others.
#pragma once

#include "capture/pass_info.h"

namespace rainref::windshield {

/// Passes, buffers and GPU layouts of the windshield.
const capture::EffectInfo& effect_info();

}  // namespace rainref::windshield
