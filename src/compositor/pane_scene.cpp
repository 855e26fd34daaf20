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
    surface.is_masked = true;
    if (shape == WaterShape::displaced) {
      surface.smooth_normals = normals_of(water_normal(pane, water));
      scene.add(std::make_shared<DisplacedWater>(pane, water, executor), surface);
    } else {
      scene.add(std::make_shared<SlopedWater>(pane, water), surface);
    }
  }
  // Water ends on the pane, so the rim need not be higher than the surface over a dry texel would be.
  scene.add(std::make_shared<PaneRim>(pane, 2 * WaterLayer::clearance), Material::of(std::move(rim)));
}

}  // namespace rainref::compositor
