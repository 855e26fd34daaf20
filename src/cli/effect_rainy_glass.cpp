#include <optional>

#include "cli/effects.h"
#include "cli/pane_tracing.h"
#include "cli/pictures.h"
#include "cli/scene_pictures.h"
#include "compositor/rainy_glass_truth.h"
#include "image_io/write.h"
#include "rainref/error.h"
#include "rainref/rainy_glass.h"
#include "rainy_glass/backdrop.h"
#include "rainy_glass/info.h"
#include "rainy_glass/parameters.h"

namespace rainref::cli {
namespace {

using rainy_glass::Settings, rainy_glass::Surroundings;

Surroundings surroundings(const scene::Config& config, const Settings& settings, const parallel::Executor& executor,
                          std::vector<InputFile>& inputs) {
  const bool corrected = settings.variant == Variant::corrected;
  const bool own_scene = !config.text("scene.image").empty();
  if (!own_scene && corrected && !config.text("scene.depth_image").empty())
    throw Error(ExitCode::usage, "scene.depth_image: expected scene.image beside it, found none");
  if (own_scene && corrected && config.text("scene.depth_image").empty())
    throw Error(ExitCode::usage, "scene.depth_image: expected a depth beside scene.image, found none");
  if (settings.shape != rainy_glass::Shape::image) refuse_unused(config, "glass.normal_image", "glass.shape");
  if (!settings.use_probe) refuse_unused(config, "glass.probe_image", "glass.background");
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
    if (config.text("glass.probe_image").empty())
      throw Error(ExitCode::usage, "glass.probe_image: expected a panorama beside scene.image, found none");
    s.probe = read_linear(config, "glass.probe_image", inputs);
  }
  if (settings.shape == rainy_glass::Shape::image) {
    if (config.text("glass.normal_image").empty())
      throw Error(ExitCode::usage, "glass.normal_image: expected a picture for glass.shape = \"image\", found none");
    const image_io::Picture p = read_input(config, "glass.normal_image", inputs);
    const bool is_code = info(p.image.format()).kind == FormatInfo::unorm8 || p.srgb_encoded;
    s.normals = floats_of(p, [&](float x, int c) { return c < 3 && is_code ? 2 * x - 1 : x; });
  }
  if (!config.text("maps.raindrops_image").empty()) s.raindrops = read_tile(config, "maps.raindrops_image", true, inputs);
  if (!config.text("maps.rivulets_image").empty()) s.rivulets = read_tile(config, "maps.rivulets_image", true, inputs);
  return s;
}

using Tracing = PaneTracing<compositor::RainyGlassView>;

class RainyGlassSimulation : public Simulation {
 public:
  RainyGlassSimulation(const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs)
      : settings_(rainy_glass::settings_from(config)),
        surroundings_(surroundings(config, settings_, executor, inputs)),
        glass_(settings_, surroundings_, executor) {
    const compositor::Choice choice = compositor::choice_from(config);
    const bool can = settings_.variant == Variant::corrected && settings_.shape == rainy_glass::Shape::pane && !settings_.use_probe &&
                     config.text("scene.image").empty() && config.text("scene.panorama").empty();
    if (!can && choice.is_traced) {
      throw Error(ExitCode::usage,
                  "compositor.picture: expected \"passes\", for rays need a pane, glass.background = \"grab\", and the street made here "
                  "instead of scene.image or scene.panorama");
    }
    if (!can) return;
    tracing_.emplace(choice, executor, [this, config, &executor](const compositor::TracerOptions& tracer) {
      rainy_glass::BackdropOptions options = rainy_glass::backdrop_from(config);
      options.bar_spacing = 0;
      unbarred_ = rainy_glass::make_backdrop(settings_, options, executor);
      return compositor::RainyGlassView(settings_, surroundings_, unbarred_, config.real("compositor.glass_thickness"), tracer);
    });
    if (is_traced()) tracing_->has_truth();
  }

  void advance(Recorder* recorder) override {
    glass_.frame(recorder);
    if (is_traced()) tracing_->trace(glass_, glass_.frames() - 1, recorder);
  }
  void show(bool is_shown) override {
    if (tracing_) tracing_->show(is_shown);
  }
  const Image& picture() const override { return is_traced() ? tracing_->shown() : glass_.picture(); }
  bool has_truth() const override { return tracing_ && tracing_->has_truth(); }
  nlohmann::ordered_json compare_truth(const std::filesystem::path& stem) override { return tracing_->write_truth(glass_, stem); }
  // The maps have a size of their own, so they get files of their own: raindrops and rivulets, EXR or, of 8 bits, PNG.
  void write_exr(const std::filesystem::path& path) const override {
    if (is_traced()) return tracing_->write_exr(path);
    const Image colour = flipped(glass_.colour()), normal = flipped(glass_.orientation()), surface = flipped(glass_.surface());
    image_io::write_exr(path, {{"", {"R", "G", "B"}, &colour}, {"normal", {"X", "Y", "Z"}, &normal}, {"glass", {"U", "V", "Z"}, &surface}});
    if (maps_are_written_) return;
    write_map(path, "raindrops", glass_.raindrops());
    write_map(path, "rivulets", glass_.rivulets());
    maps_are_written_ = true;
  }

 private:
  bool is_traced() const { return tracing_ && tracing_->is_traced(); }

  static void write_map(const std::filesystem::path& picture, const std::string& stem, const Image& map) {
    const Image top_first = flipped(map);
    if (map.format() == Format::rgba8) {
      image_io::write_png(picture.parent_path() / (stem + ".png"), top_first, image_io::PngChannels::rgba);
    } else {
      image_io::write_exr(picture.parent_path() / (stem + ".exr"), {{"", {"R", "G", "B", "A"}, &top_first}});
    }
  }

  Settings settings_;
  Surroundings surroundings_, unbarred_;  // the second when something is traced
  rainy_glass::RainyGlass glass_;
  std::optional<Tracing> tracing_;  // where there is a truth
  mutable bool maps_are_written_ = false;
};

}  // namespace

EffectEntry rainy_glass_entry() {
  static const std::vector<scene::Parameter> parameters = with_pane_tracing(rainy_glass::parameters());
  return {
      "rainy_glass",
      {"as-published", "corrected"},
      parameters,
      &rainy_glass::effect_info(),
      [](const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs) -> std::unique_ptr<Simulation> {
        return std::make_unique<RainyGlassSimulation>(config, executor, inputs);
      },
      rainy_glass_memory};
}

}  // namespace rainref::cli
