#include "cli/effects.h"
#include "cli/inputs.h"
#include "cli/pictures.h"
#include "image_io/write.h"
#include "night_street/night_street.h"
#include "puddle/info.h"
#include "puddle/parameters.h"
#include "rainref/puddle.h"

namespace rainref::cli {
namespace {

class PuddleSimulation : public Simulation {
 public:
  PuddleSimulation(const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs)
      : puddle_(puddle::settings_from(config), surroundings(config, executor, inputs), executor) {}

  void frame(Recorder* recorder) override {
    puddle_.simulate(recorder);
    puddle_.render(recorder);
  }
  const Image& picture() const override { return puddle_.picture(); }
  void write_exr(const std::filesystem::path& path) const override {
    const Image colour = flipped(puddle_.colour()), normal = flipped(puddle_.normal()), hit = flipped(puddle_.hit());
    image_io::write_exr(path, {{"", {"R", "G", "B"}, &colour}, {"normal", {"X", "Y", "Z"}, &normal}, {"position", {"X", "Y", "Z"}, &hit}});
  }

 private:
  static puddle::Surroundings surroundings(const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs) {
    puddle::Surroundings s;
    if (config.text("environment.image").empty()) {
      s.environment = night_street::Street().panorama(1024, 512, {0, 0.05, 0}, executor);
    } else {
      image_io::Picture picture = read_input(config, "environment.image", inputs);
      s.environment_is_cube = config.text("environment.layout") == "cube";
      // A panorama's v = 0 looks down; a cube's faces start at their top row, as graphics APIs have it.
      s.environment = s.environment_is_cube ? std::move(picture.image) : flipped(picture.image);
      s.environment_is_encoded = picture.srgb_encoded;
    }
    if (!config.text("puddle.ground_image").empty()) {
      image_io::Picture picture = read_input(config, "puddle.ground_image", inputs);
      s.ground = flipped(picture.image);
      s.ground_is_encoded = picture.srgb_encoded;
    }
    return s;
  }

  puddle::Puddle puddle_;
};

}  // namespace

EffectEntry puddle_entry() {
  return {"puddle", {"as-published", "corrected"}, puddle::parameters(), &puddle::effect_info(),
          [](const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs) -> std::unique_ptr<Simulation> {
            return std::make_unique<PuddleSimulation>(config, executor, inputs);
          }};
}

}  // namespace rainref::cli
