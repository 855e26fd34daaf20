#include "truth/tracing.h"
#include "truth/windshield_truth.h"
#include "windshield/instance.h"

namespace rainref::truth {
namespace {

class WindshieldTracing : public Tracing {
 public:
  WindshieldTracing(const scene::Config& config, const windshield::Instance& windshield, const effect::Inputs& inputs,
                    const parallel::Executor& on)
      : Tracing(choice_from(config), on),
        windshield_(windshield),
        view_(windshield.settings(), {config.real("compositor.glass_thickness"), config.real("compositor.glass_radius")}, choice().tracer,
              windshield.has_street() ? windshield::street_of(windshield.settings(), inputs) : nullptr, on) {}

  Comparison compare() override {
    look_outside();
    WindshieldTruth t = truth::compare(windshield_.running(), view_, choice().picture, executor());
    return {{{"glass_pixels", t.glass}, {"drop_pixels", t.drops}, {"mirrored_pixels", t.mirrored}}, std::move(t.differences)};
  }

 private:
  Picture picture() override {
    look_outside();
    const windshield::PictureSettings& p = view_.settings().picture;
    return trace_picture(*view_.scene(windshield_.running()), view_.camera(), p.width, p.height, choice().picture, executor());
  }
  Image display(const Image& radiance) const override { return truth::display(view_.settings(), radiance, executor()); }

  void look_outside() {
    if (!windshield_.has_street()) view_.show(windshield_.running().scene_colour(), windshield_.running().scene_depth());
  }

  const windshield::Instance& windshield_;
  WindshieldView view_;
};

}  // namespace

EffectTracing windshield_tracing() {
  return {"windshield",
          [] {
            std::vector<scene::Parameter> all = parameters();
            all.push_back(pane_thickness());
            all.push_back(scene::real("compositor.glass_radius", "m", 0, 1e6, 0,
                                      "Radius of its bend across the car, convex outward; 0: flat. The passes' glass is flat."));
            return all;
          },
          [](const scene::Config& config, const effect::Instance& instance, const effect::Inputs& inputs,
             const parallel::Executor& executor) -> std::unique_ptr<Tracing> {
            return std::make_unique<WindshieldTracing>(config, static_cast<const windshield::Instance&>(instance), inputs, executor);
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
