#include <atomic>

#include "screen_drops/instance.h"
#include "screen_drops/shown.h"
#include "truth/pane_tracing.h"
#include "truth/pane_truth.h"
#include "truth/screen_drops_view.h"

namespace rainref::truth {

Comparison ScreenDropsView::compare(const screen_drops::ScreenDrops& rendered, const PictureOptions& options,
                                    const parallel::Executor& executor) const {
  const PaneTruth pane(rendered, *this, options, executor);
  const screen_drops::ShownDrops pass(settings_, rendered);
  Difference refraction = pane.difference("refraction", "deg"), colour = pane.difference("colour", ""),
             colour_dry = pane.difference("colour_dry", ""), codes = pane.difference("display", "code");
  std::atomic<std::size_t> drops = 0, wets = 0, both = 0, mirrored = 0, mirrored_in_pass = 0;
  pane.each_pixel([&](int x, int y) {
    codes.at(x, y) = pane.codes_at(x, y);
    const screen_drops::Shown pixel = pass.at(x, y);
    const StraightPath path = pane.path(x, y);
    const bool is_drop = pixel.cover >= 0.5, is_mirrored = path.end == StraightPath::End::mirrored,
               is_wet = is_mirrored || path.interfaces > 2;
    drops += is_drop;
    wets += is_wet;
    if (is_drop != is_wet) return;
    (is_drop ? colour : colour_dry).at(x, y) = pane.colour_at(x, y);
    if (!is_drop) return;
    ++both;
    mirrored += is_mirrored;
    mirrored_in_pass += pixel.reflected >= 1;
    if (path.end != StraightPath::End::out || pixel.reflected >= 1) return;
    refraction.at(x, y) =
        degrees_between(pixel.bent.x * basis_.right + pixel.bent.y * basis_.up + pixel.bent.z * basis_.forward, path.direction);
  });
  return {{{"pixels", static_cast<std::size_t>(pane.width) * pane.height},
           {"drop_pixels", drops},
           {"wet_pixels", wets},
           {"drop_not_wet", drops - both},
           {"wet_not_drop", wets - both},
           {"mirrored_pixels", mirrored},
           {"mirrored_in_pass", mirrored_in_pass}},
          {refraction, colour, colour_dry, codes}};
}

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
  return {
      "screen_drops", pane_parameters,
      [](const scene::Config& config, const effect::Instance& instance, const parallel::Executor& executor) -> std::unique_ptr<Tracing> {
        const auto& drops = static_cast<const screen_drops::Instance&>(instance);
        if (drops.settings().variant != Variant::corrected) return nullptr;
        return std::make_unique<ScreenDropsTracing>(config, drops, executor);
      },
      hold_traced};
}

}  // namespace rainref::truth
