// Adds a wet pane to a scene: its surfaces, and the media on both sides of each.
#pragma once

#include <functional>
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

/// How the water's surface is intersected. `displaced` is for flat panes, including sheared ones.
enum class WaterShape : std::uint8_t { displaced, sloped };

/// Adds, in this order:
///   inner face       pane    | within
///   outer face, dry  outside | pane
///   outer face, wet  water   | pane       not if water is null
///   water's surface  outside | water      likewise; it is the masked surface
///   rim              opaque
/// with the medium of the outward side first.
void add_pane(Scene& scene, const Pane& pane, std::shared_ptr<const WaterLayer> water, WaterShape shape, std::shared_ptr<const Opaque> rim,
              const parallel::Executor& executor, const PaneMedia& media = {});

/// The part of a pane's face where a condition holds, such as wet or dry.
class FacePatch : public PaneFace {
 public:
  /// is_there: condition for (u, v) on the pane; a pure function.
  FacePatch(const Pane& pane, double lift, std::function<bool(double, double)> is_there)
      : PaneFace(pane, lift), is_there_(std::move(is_there)) {}

 protected:
  bool is_there(double u, double v) const override { return is_there_(u, v); }

 private:
  std::function<bool(double, double)> is_there_;
};

/// Adds inner face, dry and wet outer face, as add_pane does; the caller adds the water's surface and the rim.
inline void add_faces(Scene& scene, const Pane& pane, const std::function<bool(double, double)>& is_wet, const PaneMedia& media = {}) {
  scene.add(std::make_shared<PaneFace>(pane, -pane.shape().thickness), Material::interface_of(media.pane, media.within));
  scene.add(std::make_shared<FacePatch>(pane, 0, [is_wet](double u, double v) { return !is_wet(u, v); }),
            Material::interface_of(media.outside, media.pane));
  scene.add(std::make_shared<FacePatch>(pane, 0, is_wet), Material::interface_of(media.water, media.pane));
}

}  // namespace rainref::compositor
