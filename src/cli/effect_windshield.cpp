#include <fmt/format.h>

#include "cli/effects.h"
#include "cli/inputs.h"
#include "cli/pictures.h"
#include "image_io/write.h"
#include "rainref/error.h"
#include "rainref/windshield.h"
#include "windshield/info.h"
#include "windshield/scene_images.h"
#include "windshield/scene_keys.h"

namespace rainref::cli {
namespace {

class WindshieldSimulation : public Simulation {
 public:
  WindshieldSimulation(const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs)
      : windshield_(config, surroundings(config, inputs), executor) {}

  void frame(Recorder* recorder) override {
    windshield_.simulate(recorder);
    windshield_.render(recorder);
  }
  const Image& picture() const override { return windshield_.picture(); }
  void write_exr(const std::filesystem::path& path) const override {
    const Image colour = flipped(windshield_.colour());
    image_io::write_exr(path, {{"", {"R", "G", "B"}, &colour}});
  }

 private:
  static windshield::Surroundings surroundings(const scene::Config& config, std::vector<InputFile>& inputs) {
    windshield::Surroundings s;
    const bool has_depth = !config.text("scene.depth_image").empty();
    if (config.text("scene.image").empty()) {
      if (has_depth) throw Error(ExitCode::usage, config.entry("scene.depth_image").origin.at, "scene.depth_image: expected scene.image beside it, found none");
      return s;
    }
    const image_io::Picture picture = read_input(config, "scene.image", inputs);
    s.colour = windshield::linear_half(flipped(picture.image), picture.srgb_encoded);
    s.depth = windshield::far_depth(s.colour.width(), s.colour.height());
    if (has_depth) {
      const Image depth = flipped(read_input(config, "scene.depth_image", inputs).image);
      if (depth.width() != s.colour.width() || depth.height() != s.colour.height()) {
        throw Error(ExitCode::usage, config.entry("scene.depth_image").origin.at,
                    fmt::format("scene.depth_image: expected {}x{} as scene.image, found {}x{}", s.colour.width(), s.colour.height(), depth.width(), depth.height()));
      }
      s.depth = windshield::depth_of(depth);
    }
    return s;
  }

  windshield::Windshield windshield_;
};

}  // namespace

EffectEntry windshield_entry() {
  return {"windshield", {"as-published", "corrected"}, windshield::parameters(), &windshield::effect_info(),
          [](const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs) -> std::unique_ptr<Simulation> {
            return std::make_unique<WindshieldSimulation>(config, executor, inputs);
          }};
}

}  // namespace rainref::cli
