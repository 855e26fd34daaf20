#include "screen_drops/instance.h"
#include "truth/pane_tracing.h"
#include "truth/screen_drops_truth.h"

namespace rainref::truth {
namespace {

class ScreenDropsTracing : public PaneTracing<ScreenDropsView, screen_drops::Instance> {
 public:
  ScreenDropsTracing(const scene::Config& config, const screen_drops::Instance& drops, const parallel::Executor& on)
      : PaneTracing(config, drops,
                    ScreenDropsView(drops.settings(), drops.scene_colour(), config.real("compositor.glass_thickness"),
                                    choice_from(config).tracer, on),
                    on) {}

 private:
  void look_outside() override {
    if (instance().has_sequence()) view().show(instance().scene_colour());
  }
};

}  // namespace

EffectTracing screen_drops_tracing() {
  return {"screen_drops", pane_parameters,
          [](const scene::Config& config, const effect::Instance& instance, const effect::Inputs&,
             const parallel::Executor& executor) -> std::unique_ptr<Tracing> {
            const auto& drops = static_cast<const screen_drops::Instance&>(instance);
            if (drops.settings().variant != Variant::corrected) return nullptr;
            return std::make_unique<ScreenDropsTracing>(config, drops, executor);
          },
          hold_traced};
}

}  // namespace rainref::truth
