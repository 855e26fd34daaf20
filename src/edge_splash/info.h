// edge_splash described to others.
#pragma once

#include "capture/pass_info.h"

namespace rainref::edge_splash {

/// Passes, buffers and GPU layouts of edge_splash.
const capture::EffectInfo& effect_info();

}  // namespace rainref::edge_splash
