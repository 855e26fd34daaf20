#include <optional>

#include "cli/effects.h"
#include "cli/pane_tracing.h"
#include "cli/pictures.h"
#include "cli/scene_pictures.h"
#include "compositor/screen_drops_truth.h"
#include "image_io/write.h"
#include "night_street/night_street.h"
#include "rainref/screen_drops.h"
#include "scene/panorama_view.h"
#include "screen_drops/host.h"
#include "screen_drops/info.h"
#include "screen_drops/parameters.h"

namespace rainref::cli {
namespace {

using screen_drops::Settings;

constexpr double street_far = 1000;  // depth of its sky [m]; nobody looks at it

screen_drops::Inputs images(const scene::Config& config, const Settings& settings, const parallel::Executor& executor,
                            std::vector<InputFile>& files) {
  screen_drops::check(settings);
  screen_drops::Inputs in;
  const Image panorama = read_panorama(config, files);
  if (!panorama.empty()) {
    in.colour = scene::panorama_view(panorama, screen_drops::scene_camera(settings), settings.width, settings.height, executor);
  } else if (config.text("scene.image").empty()) {
    in.colour = night_street::Street({settings.seed})
                    .view(screen_drops::scene_camera(settings), settings.width, settings.height, street_far, executor)
                    .colour;
  } else {
    in.colour = read_linear(config, "scene.image", files);
  }
  if (settings.variant == Variant::as_published && !config.text("noise.image").empty())
    in.noise = read_tile(config, "noise.image", false, files);
  return in;
}

using Tracing = PaneTracing<compositor::ScreenDropsView>;

class ScreenDropsSimulation : public Simulation {
 public:
  ScreenDropsSimulation(const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& files)
      : settings_(screen_drops::settings_from(config)),
        inputs_(images(config, settings_, executor, files)),
        flow_(screen_drops::flow_from(config, settings_)),
        effect_(settings_, inputs_, executor, flow_ ? &*flow_ : nullptr) {
    if (settings_.variant != Variant::corrected) return;
    tracing_.emplace(compositor::choice_from(config), executor, [this, config, &executor](const compositor::TracerOptions& tracer) {
      return compositor::ScreenDropsView(settings_, inputs_.colour, config.real("compositor.glass_thickness"), tracer, executor);
    });
    if (is_traced()) tracing_->has_truth();
  }

  void advance(Recorder* recorder) override {
    effect_.render(recorder);
    if (is_traced()) tracing_->trace(effect_, effect_.frame() - 1, recorder);
  }
  void show(bool is_shown) override {
    if (tracing_) tracing_->show(is_shown);
  }
  const Image& picture() const override { return is_traced() ? tracing_->shown() : effect_.picture(); }
  bool has_truth() const override { return tracing_ && tracing_->has_truth(); }
  nlohmann::ordered_json compare_truth(const std::filesystem::path& stem) override { return tracing_->write_truth(effect_, stem); }
  void write_exr(const std::filesystem::path& path) const override {
    if (is_traced()) return tracing_->write_exr(path);
    const Image colour = flipped(effect_.colour()), background = flipped(effect_.background());
    image_io::write_exr(path, {{"", {"R", "G", "B"}, &colour}, {"background", {"R", "G", "B"}, &background}});
  }

 private:
  bool is_traced() const { return tracing_ && tracing_->is_traced(); }

  Settings settings_;
  screen_drops::Inputs inputs_;
  std::optional<screen_drops::FlowSettings> flow_;
  screen_drops::ScreenDrops effect_;
  std::optional<Tracing> tracing_;  // of the corrected variant
};

}  // namespace

EffectEntry screen_drops_entry() {
  static const std::vector<scene::Parameter> parameters = with_pane_tracing(screen_drops::parameters());
  return {
      "screen_drops",
      {"as-published", "corrected"},
      parameters,
      &screen_drops::effect_info(),
      [](const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs) -> std::unique_ptr<Simulation> {
        return std::make_unique<ScreenDropsSimulation>(config, executor, inputs);
      },
      screen_drops_memory};
}

}  // namespace rainref::cli
