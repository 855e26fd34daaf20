// The state of the drops after their warm-up, which is the same in every run of the same settings.
#pragma once

#include <functional>

#include "screen_drops/flow.h"
#include "state/items.h"

namespace rainref::screen_drops {

/// What list() lists is afterwards as after warm_up(), which is called unless the state is in the cache (cache/kept_images.h).
void warm_up_once(const FlowSettings& settings, const std::function<state::Items()>& list, const std::function<void()>& warm_up);

}  // namespace rainref::screen_drops
