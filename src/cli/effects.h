// One entry for each effect; effect_*.cpp define them.
#pragma once

#include "cli/registry.h"

namespace rainref::cli {

EffectEntry puddle_entry();
EffectEntry windshield_entry();
EffectEntry rainy_glass_entry();
EffectEntry edge_splash_entry();
EffectEntry screen_drops_entry();

}  // namespace rainref::cli
