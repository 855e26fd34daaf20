#include <atomic>

#include "rainref/error.h"
#include "rainy_glass/backdrop.h"
#include "rainy_glass/instance.h"
#include "rainy_glass/parameters.h"
#include "truth/pane_tracing.h"
#include "truth/pane_truth.h"
#include "truth/rainy_glass_view.h"

namespace rainref::truth {

Comparison RainyGlassView::compare(const rainy_glass::RainyGlass& rendered, const PictureOptions& options,
                                   const parallel::Executor& executor) const {
  const PaneTruth pane(rendered, *this, options, executor);
  const rainy_glass::ShownGlass pass(settings_, *around_, rendered);
  Difference refraction = pane.difference("refraction", "deg"), bend = pane.difference("bend", "deg"),
             colour = pane.difference("colour", ""), colour_dry = pane.difference("colour_dry", ""),
             codes = pane.difference("display", "code");
  std::atomic<std::size_t> glass = 0, wet = 0, pass_only = 0, truth_only = 0, mirrored = 0;
  pane.each_pixel([&](int x, int y) {
    const rainy_glass::Shown pixel = pass.at(x, y);
    if (!pixel.is_behind) return;
    ++glass;
    codes.at(x, y) = pane.codes_at(x, y);
    const Vec ray = pane.ray(x, y).direction;
    const StraightPath path = pane.path(x, y);
    const bool is_mirrored = path.end == StraightPath::End::mirrored, is_wet = is_mirrored || path.interfaces > 2;
    pass_only += pixel.is_wet && !is_wet;
    truth_only += is_wet && !pixel.is_wet;
    if (is_wet != pixel.is_wet) return;
    (is_wet ? colour : colour_dry).at(x, y) = pane.colour_at(x, y);
    if (!is_wet) return;
    ++wet;
    mirrored += is_mirrored;
    if (path.end != StraightPath::End::out) return;
    const Vec from_pass = basis_.forward + pixel.x * basis_.right + pixel.y * basis_.up,
              from_truth = met(path.origin, path.direction).from_eye;
    refraction.at(x, y) = degrees_between(from_pass, from_truth);
    bend.at(x, y) = degrees_between(ray, from_pass) - degrees_between(ray, from_truth);
  });
  return {{{"pixels", static_cast<std::size_t>(pane.width) * pane.height},
           {"glass_pixels", glass},
           {"wet_pixels", wet},
           {"wet_in_pass_only", pass_only},
           {"wet_in_truth_only", truth_only},
           {"mirrored_pixels", mirrored}},
          {refraction, bend, colour, colour_dry, codes}};
}

namespace {

RainyGlassView::Street street_behind(const scene::Config& config, const rainy_glass::Instance& glass, const effect::Inputs& inputs,
                                     const parallel::Executor& executor) {
  rainy_glass::BackdropOptions options = rainy_glass::backdrop_from(config);
  options.bar_spacing = 0;
  auto scenery = effect::street_of(inputs, {glass.settings().seed});
  rainy_glass::Surroundings unbarred = rainy_glass::make_backdrop(glass.settings(), options, *scenery, executor);
  return {std::move(scenery), std::move(unbarred)};
}

class RainyGlassTracing : public PaneTracing<RainyGlassView, rainy_glass::Instance> {
 public:
  /// street: none if the scene comes in pictures.
  RainyGlassTracing(const scene::Config& config, const rainy_glass::Instance& glass, std::optional<RainyGlassView::Street> street,
                    const parallel::Executor& on)
      : PaneTracing(config, glass,
                    RainyGlassView(glass.settings(), glass.surroundings(), std::move(street), config.real("compositor.glass_thickness"),
                                   choice_from(config).tracer),
                    on),
        comes_in_pictures_(effect::is_named(config, "scene.image")) {}

 private:
  void look_outside() override {
    if (comes_in_pictures_) view().show(instance().running().surface());
  }
  bool comes_in_pictures_;
};

}  // namespace

EffectTracing rainy_glass_tracing() {
  return {"rainy_glass", pane_parameters,
          [](const scene::Config& config, const effect::Instance& instance, const effect::Inputs& inputs,
             const parallel::Executor& executor) -> std::unique_ptr<Tracing> {
            const auto& glass = static_cast<const rainy_glass::Instance&>(instance);
            const rainy_glass::Settings& s = glass.settings();
            const bool can = s.variant == Variant::corrected && s.shape == rainy_glass::Shape::pane && !s.use_probe &&
                             config.text("scene.panorama").empty();
            if (can && effect::is_named(config, "scene.image"))
              return std::make_unique<RainyGlassTracing>(config, glass, std::nullopt, executor);
            if (can) return std::make_unique<RainyGlassTracing>(config, glass, street_behind(config, glass, inputs, executor), executor);
            if (!choice_from(config).is_traced) return nullptr;
            throw Error(ExitCode::usage,
                        "compositor.picture: expected \"passes\", for rays need a pane, glass.background = \"grab\", and depths, which "
                        "scene.panorama has not");
          },
          [](effect::RunMemory& m, const scene::Config& config) {
            // The scene without bars.
            if (choice_from(config).is_traced) m.peak.hold(image_bytes(m, Format::rgba32f) + image_bytes(m, Format::r32f));
            hold_traced(m, config);
          }};
}

}  // namespace rainref::truth
