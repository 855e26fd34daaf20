// A wet pane put into a scene: which surfaces it has, and which medium lies on which side of each.
#pragma once

#include <memory>

#include "compositor/pane.h"
#include "compositor/scene.h"
#include "compositor/water_layer.h"

namespace rainref::compositor {

struct PaneMedia {
  Medium within = air();  ///< on the side of the inner face
  Medium pane = glass();
  Medium water = compositor::water();
  Medium outside = air();
};

/// How the water's surface is met. `displaced` is for flat panes, sheared ones included.
enum class WaterShape : std::uint8_t { displaced, sloped };

/// Adds, in this order:
///   inner face       pane    | within
///   outer face, dry  outside | pane
///   outer face, wet  water   | pane       not where water is null
///   water's surface  outside | water      likewise; it is the masked surface
///   rim              opaque
/// with the medium of the outward side first.
void add_pane(Scene& scene, const Pane& pane, std::shared_ptr<const WaterLayer> water, WaterShape shape, std::shared_ptr<const Opaque> rim,
              const parallel::Executor& executor, const PaneMedia& media = {});

}  // namespace rainref::compositor
