#include "compositor/pane_scene.h"

namespace rainref::compositor {

void add_pane(Scene& scene, const Pane& pane, std::shared_ptr<const WaterLayer> water, WaterShape shape, std::shared_ptr<const Opaque> rim,
              const parallel::Executor& executor, const PaneMedia& media) {
  scene.add(std::make_shared<PaneFace>(pane, -pane.shape().thickness), Material::interface_of(media.pane, media.within));
  if (!water) {
    scene.add(std::make_shared<PaneFace>(pane, 0), Material::interface_of(media.outside, media.pane));
  } else {
    scene.add(std::make_shared<OuterFace>(pane, water, false), Material::interface_of(media.outside, media.pane));
    scene.add(std::make_shared<OuterFace>(pane, water, true), Material::interface_of(media.water, media.pane));
    Material surface = Material::interface_of(media.outside, media.water);
    surface.smooth_normal = water_normal(pane, water);
    surface.is_masked = true;
    if (shape == WaterShape::displaced) scene.add(std::make_shared<DisplacedWater>(pane, water, executor), surface);
    else scene.add(std::make_shared<SlopedWater>(pane, water), surface);
  }
  scene.add(std::make_shared<PaneRim>(pane, 1e-4 + WaterLayer::clearance + (water ? water->highest() : 0)), Material::of(std::move(rim)));
}

}  // namespace rainref::compositor
