// rainy_glass described to others.
#pragma once

#include "capture/pass_info.h"

namespace rainref::rainy_glass {

/// Passes, buffers and GPU layouts of rainy_glass.
const capture::EffectInfo& effect_info();

}  // namespace rainref::rainy_glass
