#include "rainref/error.h"
#include "rainy_glass/backdrop.h"
#include "rainy_glass/instance.h"
#include "rainy_glass/parameters.h"
#include "truth/pane_tracing.h"
#include "truth/rainy_glass_truth.h"

namespace rainref::truth {
namespace {

using rainy_glass::Surroundings;

/// The scene without anything before the glass.
std::unique_ptr<const Surroundings> unbarred(const scene::Config& config, const rainy_glass::Instance& glass,
                                             const parallel::Executor& executor) {
  rainy_glass::BackdropOptions options = rainy_glass::backdrop_from(config);
  options.bar_spacing = 0;
  return std::make_unique<const Surroundings>(rainy_glass::make_backdrop(glass.settings(), options, executor));
}

class RainyGlassTracing : public PaneTracing<RainyGlassView, rainy_glass::Instance> {
 public:
  /// street: without anything before the glass; null where the scene comes in pictures.
  RainyGlassTracing(const scene::Config& config, const rainy_glass::Instance& glass, std::unique_ptr<const Surroundings> street,
                    const parallel::Executor& on)
      : PaneTracing(config, glass,
                    RainyGlassView(glass.settings(), glass.surroundings(), street.get(), config.real("compositor.glass_thickness"),
                                   choice_from(config).tracer),
                    on),
        street_(std::move(street)) {}

 private:
  void look_outside() override {
    if (!street_) view().show(instance().running().surface());
  }
  std::unique_ptr<const Surroundings> street_;  // which the view refers to
};

}  // namespace

EffectTracing rainy_glass_tracing() {
  return {
      "rainy_glass", pane_parameters,
      [](const scene::Config& config, const effect::Instance& instance, const parallel::Executor& executor) -> std::unique_ptr<Tracing> {
        const auto& glass = static_cast<const rainy_glass::Instance&>(instance);
        const rainy_glass::Settings& s = glass.settings();
        const bool can =
            s.variant == Variant::corrected && s.shape == rainy_glass::Shape::pane && !s.use_probe && config.text("scene.panorama").empty();
        if (can && effect::is_named(config, "scene.image")) return std::make_unique<RainyGlassTracing>(config, glass, nullptr, executor);
        if (can) return std::make_unique<RainyGlassTracing>(config, glass, unbarred(config, glass, executor), executor);
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
