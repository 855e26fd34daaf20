#include "truth/windshield_view.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "math/real64.h"
#include "truth/falling_rain_index.h"
#include "truth/pane_tracing.h"
#include "truth/pane_truth.h"
#include "windshield/instance.h"
#include "windshield/motion/glass.h"
#include "windshield/scene/street.h"
#include "windshield/shown.h"

namespace rainref::truth {

Image WindshieldView::display(const Image& radiance, const parallel::Executor& executor) const {
  return display_of(settings_.picture.exposure, settings_.surface.rounding, radiance, executor);
}

Comparison WindshieldView::compare(const windshield::Windshield& rendered, const PictureOptions& options,
                                   const parallel::Executor& executor) const {
  const PaneTruth pane(rendered, *this, options, executor);
  const windshield::ShownScene composite(settings_, rendered);
  const Vec eye = camera().position;
  const double way = distance(rendered);
  Difference refraction = pane.difference("refraction", "deg"), refraction_film = pane.difference("refraction_film", "deg"),
             colour = pane.difference("colour", ""), colour_film = pane.difference("colour_film", ""),
             codes = pane.difference("display", "code");
  std::atomic<std::size_t> glass = 0, drops = 0, mirrored = 0;
  pane.each_pixel([&](int x, int y) {
    const windshield::Shown pixel = composite.at(x, y);
    if (!pixel.is_on_glass) return;
    const bool is_drop = pixel.visibility >= 0.5;
    ++glass;
    drops += is_drop;
    (is_drop ? colour : colour_film).at(x, y) = pane.colour_at(x, y);
    codes.at(x, y) = pane.codes_at(x, y);
    const StraightPath path = pane.path(x, y);
    const bool is_wet = path.interfaces > 2;
    if (is_drop && path.end == StraightPath::End::mirrored) ++mirrored;
    if (path.end != StraightPath::End::out || is_drop != is_wet || (!is_drop && pixel.visibility > 0)) return;
    const scene::Scenery::Sight seen = look(way, path.origin, path.direction);
    const bool is_sky = std::isinf(seen.distance);
    const Vec from_eye = is_sky ? path.direction : path.origin + seen.distance * path.direction - eye;
    const Vec from_trick = pane.basis.forward + pixel.x * pane.basis.right + pixel.y * pane.basis.up;
    (is_drop ? refraction : refraction_film).at(x, y) = degrees_between(from_trick, from_eye);
  });
  return {{{"glass_pixels", glass}, {"drop_pixels", drops}, {"mirrored_pixels", mirrored}},
          {refraction, refraction_film, colour, colour_film, codes}};
}

namespace {

class WindshieldTracing : public PaneTracing<WindshieldView, windshield::Instance> {
 public:
  WindshieldTracing(const scene::Config& config, const windshield::Instance& windshield, const effect::Inputs& inputs,
                    const parallel::Executor& on)
      : PaneTracing(
            config, windshield,
            WindshieldView(windshield.settings(), {config.real("compositor.glass_thickness"), config.real("compositor.glass_radius")},
                           choice_from(config).tracer,
                           windshield.has_street() ? windshield::street_of(windshield.settings(), inputs) : nullptr, on),
            on) {}

 private:
  void look_outside() override {
    if (!instance().has_street()) view().show(instance().running().scene_colour(), instance().running().scene_depth());
  }
};

}  // namespace

EffectTracing windshield_tracing() {
  return {"windshield",
          [] {
            std::vector<scene::Parameter> all = parameters();
            all.push_back(pane_thickness());
            all.push_back(scene::real("compositor.glass_radius", "m", 0, 1e6, 0,
                                      "Radius of the bend across the car, convex outward; 0: flat. The passes' glass is flat."));
            return all;
          },
          [](const scene::Config& config, const effect::Instance& instance, const effect::Inputs& inputs,
             const parallel::Executor& executor) -> std::unique_ptr<Tracing> {
            return std::make_unique<WindshieldTracing>(config, static_cast<const windshield::Instance&>(instance), inputs, executor);
          },
          [](effect::RunMemory& m, const scene::Config& config) {
            // The pictures for lookups by rays: floats, and their depths. Their size is unknown yet, so the street's is assumed, as in the
            // effect.
            const auto [width, height] = config.integer2("scene.size");
            if (choice_from(config).is_traced && effect::is_named(config, "scene.image"))
              m.peak.hold(static_cast<std::size_t>(width * height) * (4 + 1) * sizeof(float));
            hold_traced(m, config);
          }};
}

namespace {

Vec vec(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

PaneShape shape_of(const windshield::Corners& corners, const WindshieldGlass& glass) {
  const windshield::Glass plane = windshield::make_glass(corners);
  return {vec(plane.origin), vec(plane.e_u), vec(plane.e_v), vec(plane.normal), glass.thickness, glass.radius};
}

/// The street or the pictures outside, and the dark cabin for rays that stay on the driver's side or return to the car.
class OutsideCar : public Environment {
 public:
  OutsideCar(const WindshieldView& view, double distance, std::span<const windshield::FallingDropView> falling)
      : view_(view), falling_(falling), distance_(distance) {
    for (const Pane& pane : view.panes()) outward_.push_back(pane.normal(0.5));
  }

  void radiance(const EscapedRays& escaped_rays, std::span<Vec> out) const override {
    const windshield::Settings& s = view_.settings();
    const Vec cabin = vec(s.picture.cabin), fog = vec(s.blur.fog_colour);
    for (std::size_t i = 0; i < escaped_rays.size(); ++i) {
      const EscapedRay escaped_ray = escaped_rays[i];
      if (!is_outside(escaped_ray)) {
        out[i] = cabin;
        continue;
      }
      const scene::Scenery::Sight seen = view_.look(distance_, escaped_ray.origin, escaped_ray.direction);
      // The fog of level 0 of the blur pyramid, by the length of the ray; the sky has the largest distance.
      const double far = std::min(seen.distance, windshield::street_far), clear = exp_real(Real64(-s.blur.fog_density * far)).v;
      out[i] = falling_.through(escaped_ray.origin, escaped_ray.direction, seen.distance, (1 - clear) * fog + clear * seen.radiance);
    }
  }

 private:
  /// A ray that was cut off at the inner face looks out as if nothing followed. A ray that left through a pane begins at its surface.
  bool is_outside(const EscapedRay& ray) const {
    const std::vector<Pane>& panes = view_.panes();
    for (std::size_t k = 0; k < panes.size(); ++k) {
      const double lift = panes[k].coordinates(ray.origin).lift;
      const bool is_here = panes.size() == 1 || lift < near_surface;
      if (is_here && !(lift < -1.001 * panes[k].shape().thickness) && dot(ray.direction, outward_[k]) > 0) return true;
    }
    return false;
  }
  static constexpr double near_surface = 0.05;  // m: above any drop, less than the gap between two panes

  const WindshieldView& view_;
  FallingRainIndex falling_;
  double distance_;
  std::vector<Vec> outward_;
};

}  // namespace

WindshieldView::WindshieldView(const windshield::Settings& settings, const WindshieldGlass& glass, const TracerOptions& tracer,
                               std::shared_ptr<const scene::Scenery> street, const parallel::Executor& executor)
    : settings_(settings),
      tracer_(tracer),
      executor_(executor),
      panes_{Pane(shape_of(settings.corners, glass))},
      vehicle_(settings.vehicle),
      street_(std::move(street)) {
  for (const windshield::Corners& corners : settings.panes) panes_.emplace_back(shape_of(corners, {glass.thickness, 0}));
}

void WindshieldView::show(const Image& colour, const Image& depth) {
  const double half_height = camera().half_height() * settings_.picture.scene_margin;
  pictures_.emplace(camera(), half_height * settings_.picture.width / settings_.picture.height, half_height, colour, depth);
}

scene::Scenery::Sight WindshieldView::look(double distance, const Vec& origin, const Vec& direction) const {
  if (pictures_) {
    const PictureRelief::Sight seen = pictures_->look(origin, direction);
    return {seen.radiance, seen.distance};
  }
  const Vec place = windshield::place_in_street(settings_.street_start, distance);
  return street_->look(place + windshield::in_street(origin), windshield::in_street(direction));
}

double WindshieldView::distance(const windshield::Windshield& rendered) const {
  const double time = std::max(0, rendered.frame() - 1) / settings_.fps;
  return settings_.scene_moves ? vehicle_.at(time).distance : 0;
}

std::unique_ptr<Scene> WindshieldView::scene(const windshield::Windshield& rendered) const {
  std::vector<const Image*> heights;
  for (int k = 0; k < rendered.panes(); ++k) heights.push_back(&rendered.height(k));
  return scene(heights, distance(rendered), rendered.falling());
}

std::unique_ptr<Scene> WindshieldView::scene(std::span<const Image* const> heights, double distance,
                                             std::span<const windshield::FallingDropView> falling) const {
  auto scene = std::make_unique<Scene>(tracer_);
  PaneMedia media;
  media.water = water(settings_.picture.water_ior);
  for (std::size_t k = 0; k < heights.size(); ++k)
    add_pane(*scene, panes_[k], std::make_shared<const WaterLayer>(*heights[k]),
             panes_[k].is_flat() ? WaterShape::displaced : WaterShape::sloped, emitter(vec(settings_.picture.cabin)), executor_, media);
  scene->set_environment(std::make_shared<OutsideCar>(*this, distance, falling));
  scene->commit();
  return scene;
}

}  // namespace rainref::truth
