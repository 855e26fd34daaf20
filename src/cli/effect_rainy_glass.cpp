#include "cli/effects.h"
#include "cli/pictures.h"
#include "cli/scene_pictures.h"
#include "image_io/write.h"
#include "rainref/error.h"
#include "rainref/rainy_glass.h"
#include "rainy_glass/backdrop.h"
#include "rainy_glass/info.h"
#include "rainy_glass/parameters.h"

namespace rainref::cli {
namespace {

using rainy_glass::Settings, rainy_glass::Surroundings;

Surroundings surroundings(const scene::Config& config, const Settings& settings, const parallel::Executor& executor, std::vector<InputFile>& inputs) {
  const bool corrected = settings.variant == rainy_glass::Variant::corrected;
  const bool own_scene = !config.text("scene.image").empty();
  if (!own_scene && corrected && !config.text("scene.depth_image").empty()) throw Error(ExitCode::usage, "scene.depth_image: expected scene.image beside it, found none");
  if (own_scene && corrected && config.text("scene.depth_image").empty()) throw Error(ExitCode::usage, "scene.depth_image: expected a depth beside scene.image, found none");
  const Image panorama = read_panorama(config, inputs);
  Surroundings s;
  if (own_scene) {
    s.colour = read_linear(config, "scene.image", inputs);
    if (corrected) s.depth = read_depth(config, s.colour, inputs);
  } else {
    Settings street = settings;
    street.use_probe = settings.use_probe && config.text("glass.probe_image").empty();
    s = rainy_glass::make_backdrop(street, rainy_glass::backdrop_from(config), executor, panorama);
  }
  if (settings.use_probe && s.probe.empty()) {
    if (config.text("glass.probe_image").empty()) throw Error(ExitCode::usage, "glass.probe_image: expected a panorama beside scene.image, found none");
    s.probe = read_linear(config, "glass.probe_image", inputs);
  }
  if (settings.shape == rainy_glass::Shape::image) {
    if (config.text("glass.normal_image").empty()) throw Error(ExitCode::usage, "glass.normal_image: expected a picture for glass.shape = \"image\", found none");
    const image_io::Picture p = read_input(config, "glass.normal_image", inputs);
    const bool is_code = info(p.image.format()).kind == FormatInfo::unorm8 || p.srgb_encoded;
    s.normals = floats_of(p, [&](float x, int c) { return c < 3 && is_code ? 2 * x - 1 : x; });
  }
  if (!config.text("maps.raindrops_image").empty()) s.raindrops = read_tile(config, "maps.raindrops_image", true, inputs);
  if (!config.text("maps.rivulets_image").empty()) s.rivulets = read_tile(config, "maps.rivulets_image", true, inputs);
  return s;
}

class RainyGlassSimulation : public Simulation {
 public:
  RainyGlassSimulation(const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs)
      : RainyGlassSimulation(rainy_glass::settings_from(config), config, executor, inputs) {}

  void frame(Recorder* recorder) override { glass_.frame(recorder); }
  const Image& picture() const override { return glass_.picture(); }
  // The maps have a size of their own, so they get files of their own: raindrops and rivulets, EXR or, of 8 bits, PNG.
  void write_exr(const std::filesystem::path& path) const override {
    const Image colour = flipped(glass_.colour()), normal = flipped(glass_.orientation()), surface = flipped(glass_.surface());
    image_io::write_exr(path, {{"", {"R", "G", "B"}, &colour}, {"normal", {"X", "Y", "Z"}, &normal}, {"glass", {"U", "V", "Z"}, &surface}});
    if (maps_are_written_) return;
    write_map(path, "raindrops", glass_.raindrops());
    write_map(path, "rivulets", glass_.rivulets());
    maps_are_written_ = true;
  }

 private:
  RainyGlassSimulation(const Settings& settings, const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs)
      : glass_(settings, surroundings(config, settings, executor, inputs), executor) {}

  static void write_map(const std::filesystem::path& picture, const std::string& stem, const Image& map) {
    const Image top_first = flipped(map);
    if (map.format() == Format::rgba8) {
      image_io::write_png(picture.parent_path() / (stem + ".png"), top_first, image_io::PngChannels::rgba);
    } else {
      image_io::write_exr(picture.parent_path() / (stem + ".exr"), {{"", {"R", "G", "B", "A"}, &top_first}});
    }
  }

  rainy_glass::RainyGlass glass_;
  mutable bool maps_are_written_ = false;
};

}  // namespace

EffectEntry rainy_glass_entry() {
  return {"rainy_glass", {"as-published", "corrected"}, rainy_glass::parameters(), &rainy_glass::effect_info(),
          [](const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs) -> std::unique_ptr<Simulation> {
            return std::make_unique<RainyGlassSimulation>(config, executor, inputs);
          }};
}

}  // namespace rainref::cli
