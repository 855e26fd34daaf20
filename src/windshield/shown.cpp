#include "windshield/shown.h"

#include "windshield/scalar.h"

namespace rainref::windshield {

using Number = scalar::Scalar<double>;

ShownScene::ShownScene(const Settings& settings, const Windshield& rendered)
    : uniforms_(composite_uniforms(settings.picture, settings.corners)),
      corrected_(settings.corrected),
      depth_(rendered.scene_depth(), Address::clamp, Address::clamp),
      height_(rendered.height(), Address::clamp, Address::clamp),
      normal_(rendered.normal(), Address::clamp, Address::clamp),
      mask_(rendered.mask(), Address::clamp, Address::clamp) {}

Shown ShownScene::at(int column, int row) const {
  const CompositeUniforms& c = uniforms_;
  const auto g = scalar::glass_point<Number>(c, column, row);
  const auto w = scalar::water_at<Number>(height_.view(), normal_.view(), mask_.view(), g);
  Number visibility = scalar::smoothstep(c.visible_from, c.visible_to, w.height);
  scalar::ScenePoint<Number> shown;
  if (corrected_) {
    const auto ray = normalize(scalar::Vec3<Number>(g.x, g.y, Number(1.0f)));
    const auto bent = scalar::through_water(ray, scalar::Vec3<Number>(c.outward), scalar::to_camera(c, w.normal), c.water_ior);
    shown = scalar::shown_corrected(c, depth_.view(), g, bent);
  } else {
    visibility = visibility * (Number(1.0f) - w.mask);
    shown = scalar::shown_as_published(c, g, w, visibility);
  }
  return {g.on_glass.v > 0.5, visibility.v, (shown.u.v - 0.5) / c.scene_scale[0], (shown.v.v - 0.5) / c.scene_scale[1]};
}

}  // namespace rainref::windshield
