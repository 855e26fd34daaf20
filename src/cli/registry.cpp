#include "cli/registry.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/pictures.h"
#include "image_io/read.h"
#include "image_io/write.h"
#include "night_street/night_street.h"
#include "puddle/info.h"
#include "puddle/parameters.h"
#include "rainref/error.h"
#include "rainref/puddle.h"

namespace rainref::cli {
namespace {

image_io::Picture read_input(const scene::Config& config, const std::string& key, std::vector<InputFile>& inputs) {
  std::filesystem::path path = config.text(key);
  // A file that the scene names lies beside the scene; one from the command line where the user stands.
  const auto& origin = config.entry(key).origin;
  if (path.is_relative() && origin.kind == scene::Origin::file) path = config.directory() / path;
  image_io::Picture picture;
  try {
    picture = image_io::read(path);
  } catch (const Error& e) {
    if (origin.kind == scene::Origin::file) throw Error(e.code(), origin.at, fmt::format("{}: {}", key, e.what()));
    throw Error(e.code(), fmt::format("--set {}: {}", key, e.what()));
  }
  inputs.push_back({key, config.text(key), picture.decoded_hash.text(), picture.lossy});
  return picture;
}

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

const std::vector<EffectEntry>& effects() {
  static const std::vector<EffectEntry> all{
      {"puddle", {"as-published", "corrected"}, puddle::parameters(), &puddle::effect_info(),
       [](const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs) -> std::unique_ptr<Simulation> {
         return std::make_unique<PuddleSimulation>(config, executor, inputs);
       }}};
  return all;
}

const EffectEntry& effect(std::string_view name) {
  const scene::Effect& found = effect_table().find(name);
  return *std::find_if(effects().begin(), effects().end(), [&](const EffectEntry& e) { return e.name == found.name; });
}

const scene::EffectTable& effect_table() {
  static const scene::EffectTable table = [] {
    scene::EffectTable t;
    for (const EffectEntry& e : effects()) t.effects.push_back({e.name, e.variants, e.parameters});
    return t;
  }();
  return table;
}

}  // namespace rainref::cli
