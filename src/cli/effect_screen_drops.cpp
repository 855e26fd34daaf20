#include <optional>

#include "cli/effects.h"
#include "cli/pictures.h"
#include "cli/scene_pictures.h"
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

screen_drops::Inputs images(const scene::Config& config, const Settings& settings, const parallel::Executor& executor, std::vector<InputFile>& files) {
  screen_drops::check(settings);
  screen_drops::Inputs in;
  const Image panorama = read_panorama(config, files);
  if (!panorama.empty()) {
    in.colour = scene::panorama_view(panorama, screen_drops::scene_camera(settings), settings.width, settings.height, executor);
  } else if (config.text("scene.image").empty()) {
    in.colour = night_street::Street({settings.seed}).view(screen_drops::scene_camera(settings), settings.width, settings.height, street_far, executor).colour;
  } else {
    in.colour = read_linear(config, "scene.image", files);
  }
  if (settings.variant == screen_drops::Variant::as_published && !config.text("noise.image").empty()) in.noise = read_tile(config, "noise.image", false, files);
  return in;
}

class ScreenDropsSimulation : public Simulation {
 public:
  ScreenDropsSimulation(const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& files)
      : ScreenDropsSimulation(screen_drops::settings_from(config), config, executor, files) {}

  void frame(Recorder* recorder) override { effect_.render(recorder); }
  const Image& picture() const override { return effect_.picture(); }
  void write_exr(const std::filesystem::path& path) const override {
    const Image colour = flipped(effect_.colour()), background = flipped(effect_.background());
    image_io::write_exr(path, {{"", {"R", "G", "B"}, &colour}, {"background", {"R", "G", "B"}, &background}});
  }

 private:
  ScreenDropsSimulation(const Settings& settings, const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& files)
      : effect_(make(settings, screen_drops::flow_from(config, settings), images(config, settings, executor, files), executor)) {}
  static screen_drops::ScreenDrops make(const Settings& settings, const std::optional<screen_drops::FlowSettings>& flow, const screen_drops::Inputs& in, const parallel::Executor& executor) {
    return {settings, in, executor, flow ? &*flow : nullptr};
  }

  screen_drops::ScreenDrops effect_;
};

}  // namespace

EffectEntry screen_drops_entry() {
  return {"screen_drops", {"as-published", "corrected"}, screen_drops::parameters(), &screen_drops::effect_info(),
          [](const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs) -> std::unique_ptr<Simulation> {
            return std::make_unique<ScreenDropsSimulation>(config, executor, inputs);
          }};
}

}  // namespace rainref::cli
