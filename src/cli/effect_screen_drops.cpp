#include <optional>

#include "cli/effects.h"
#include "cli/inputs.h"
#include "cli/pictures.h"
#include "image/colour.h"
#include "image/texture.h"
#include "image_io/write.h"
#include "night_street/night_street.h"
#include "rainref/screen_drops.h"
#include "screen_drops/host.h"
#include "screen_drops/info.h"
#include "screen_drops/parameters.h"

namespace rainref::cli {
namespace {

using screen_drops::Settings;

constexpr double street_far = 1000;  // depth of its sky [m]; nobody looks at it

/// Row 0 = bottom, linear rgba32f.
Image linear(const image_io::Picture& p) {
  const Image image = flipped(p.image);
  const TextureData decoded(image, Address::clamp, Address::clamp);
  Image out(Format::rgba32f, image.width(), image.height());
  const float* in = decoded.view().texels;
  for (int y = 0; y < image.height(); ++y) {
    for (int i = 0; i < 4 * image.width(); ++i, ++in) out.row<float>(y)[i] = i % 4 < 3 && p.srgb_encoded ? static_cast<float>(decode_srgb(*in)) : *in;
  }
  return out;
}

screen_drops::Inputs images(const scene::Config& config, const Settings& settings, const parallel::Executor& executor, std::vector<InputFile>& files) {
  screen_drops::check(settings);
  screen_drops::Inputs in;
  if (config.text("scene.image").empty()) {
    in.colour = night_street::Street({settings.seed}).view(screen_drops::scene_camera(settings), settings.width, settings.height, street_far, executor).colour;
  } else {
    in.colour = linear(read_input(config, "scene.image", files));
  }
  if (settings.variant == screen_drops::Variant::as_published && !config.text("noise.image").empty()) in.noise = flipped(read_input(config, "noise.image", files).image);
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
