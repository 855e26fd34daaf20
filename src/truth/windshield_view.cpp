#include "truth/windshield_view.h"

#include <algorithm>
#include <cmath>

#include "math/real64.h"
#include "windshield/glass.h"
#include "windshield/street.h"

namespace rainref::truth {
namespace {

Vec vec(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

PaneShape shape_of(const windshield::Corners& corners, const WindshieldGlass& glass) {
  const windshield::Glass plane = windshield::make_glass(corners);
  return {vec(plane.origin), vec(plane.e_u), vec(plane.e_v), vec(plane.normal), glass.thickness, glass.radius};
}

/// The street outside, and the dark cabin for whatever stays on the driver's side or comes back to the car.
class Outside : public Environment {
 public:
  Outside(const WindshieldView& view, double distance)
      : view_(view), place_(windshield::place_in_street(view.settings().street_start, distance)), outward_(view.pane().normal(0.5)) {}

  void radiance(const EscapedRays& escaped_rays, std::span<Vec> out) const override {
    const windshield::Settings& s = view_.settings();
    const Vec cabin = vec(s.picture.cabin), fog = vec(s.blur.fog_colour);
    for (std::size_t i = 0; i < escaped_rays.size(); ++i) {
      const EscapedRay escaped_ray = escaped_rays[i];
      // A ray that was cut off at the inner face looks out as if nothing followed.
      const bool is_inside = view_.pane().coordinates(escaped_ray.origin).lift < -1.001 * view_.pane().shape().thickness;
      if (is_inside || dot(escaped_ray.direction, outward_) <= 0) {
        out[i] = cabin;
        continue;
      }
      const night_street::Street::Sight seen =
          view_.street().look(place_ + windshield::in_street(escaped_ray.origin), windshield::in_street(escaped_ray.direction));
      // The fog of level 0 of the blur pyramid, by the length of the ray; there the sky is as far as can be.
      const double far = std::min(seen.distance, windshield::street_far), clear = exp_real(Real64(-s.blur.fog_density * far)).v;
      out[i] = (1 - clear) * fog + clear * seen.radiance;
    }
  }

 private:
  const WindshieldView& view_;
  Vec place_, outward_;
};

}  // namespace

WindshieldView::WindshieldView(const windshield::Settings& settings, const WindshieldGlass& glass, const TracerOptions& tracer,
                               const parallel::Executor& executor)
    : settings_(settings),
      tracer_(tracer),
      executor_(executor),
      pane_(shape_of(settings.corners, glass)),
      vehicle_(settings.vehicle),
      street_({settings.seed, settings.clear_lane}) {}

double WindshieldView::distance(const windshield::Windshield& rendered) const {
  const double time = std::max(0, rendered.frame() - 1) / settings_.fps;
  return settings_.scene_moves ? vehicle_.at(time).distance : 0;
}

std::unique_ptr<Scene> WindshieldView::scene(const windshield::Windshield& rendered) const {
  return scene(rendered.height(), distance(rendered));
}

std::unique_ptr<Scene> WindshieldView::scene(const Image& height, double distance) const {
  auto scene = std::make_unique<Scene>(tracer_);
  PaneMedia media;
  media.water = water(settings_.picture.water_ior);
  add_pane(*scene, pane_, std::make_shared<const WaterLayer>(height), pane_.is_flat() ? WaterShape::displaced : WaterShape::sloped,
           emitter(vec(settings_.picture.cabin)), executor_, media);
  scene->set_environment(std::make_shared<Outside>(*this, distance));
  scene->commit();
  return scene;
}

}  // namespace rainref::truth
