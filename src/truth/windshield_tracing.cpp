#include <atomic>
#include <cmath>

#include "truth/pane_tracing.h"
#include "truth/pane_truth.h"
#include "truth/windshield_view.h"
#include "windshield/instance.h"
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
    const night_street::Street::Sight seen = look(way, path.origin, path.direction);
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
  WindshieldTracing(const scene::Config& config, const windshield::Instance& windshield, const parallel::Executor& on)
      : PaneTracing(
            config, windshield,
            WindshieldView(windshield.settings(), {config.real("compositor.glass_thickness"), config.real("compositor.glass_radius")},
                           choice_from(config).tracer, on),
            on) {}

 private:
  void look_outside() override {
    if (!instance().has_street()) view().show(instance().running().scene_colour(), instance().running().scene_depth());
  }
};

}  // namespace

EffectTracing windshield_tracing() {
  return {
      "windshield",
      [] {
        std::vector<scene::Parameter> all = parameters();
        all.push_back(pane_thickness());
        all.push_back(scene::real("compositor.glass_radius", "m", 0, 1e6, 0,
                                  "Radius of its bend across the car, convex outward; 0: flat. The passes' glass is flat."));
        return all;
      },
      [](const scene::Config& config, const effect::Instance& instance, const parallel::Executor& executor) -> std::unique_ptr<Tracing> {
        return std::make_unique<WindshieldTracing>(config, static_cast<const windshield::Instance&>(instance), executor);
      },
      [](effect::RunMemory& m, const scene::Config& config) {
        // The pictures as rays look them up: floats, and their depths. Their size is not known yet; as the effect does, the street's
        // counts.
        const auto [width, height] = config.integer2("scene.size");
        if (choice_from(config).is_traced && effect::is_named(config, "scene.image"))
          m.peak.hold(static_cast<std::size_t>(width * height) * (4 + 1) * sizeof(float));
        hold_traced(m, config);
      }};
}

}  // namespace rainref::truth
