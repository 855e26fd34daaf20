#include <fmt/format.h>

#include "cli/effects.h"
#include "cli/pictures.h"
#include "cli/scene_pictures.h"
#include "cli/terminal.h"
#include "edge_splash/host.h"
#include "edge_splash/info.h"
#include "edge_splash/parameters.h"
#include "edge_splash/shapes.h"
#include "image_io/write.h"
#include "night_street/night_street.h"
#include "rainref/edge_splash.h"
#include "rainref/error.h"

namespace rainref::cli {
namespace {

class EdgeSplashSimulation : public Simulation {
 public:
  EdgeSplashSimulation(const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& files)
      : effect_(edge_splash::settings_from(config), pictures(config, executor, files), executor) {
    for (const std::string& warning : effect_.warnings()) complain("warning: " + warning);
  }

  void advance(Recorder* recorder) override { effect_.render(recorder); }
  const Image& picture() const override { return effect_.picture(); }
  void write_exr(const std::filesystem::path& path) const override {
    const Image colour = flipped(effect_.colour()), depth = flipped(effect_.depth());
    image_io::write_exr(path, {{"", {"R", "G", "B", "A"}, &colour}, {"depth", {"Z"}, &depth}});
  }

 private:
  static edge_splash::Inputs pictures(const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& files) {
    edge_splash::Inputs in;
    const edge_splash::Settings s = edge_splash::settings_from(config);
    const std::string source = config.text("scene.source");
    edge_splash::check(s);
    if (source == "files") {
      for (const char* key : {"scene.image", "scene.depth_image"}) {
        if (config.text(key).empty())
          throw Error(ExitCode::usage, fmt::format("{}: expected a file, because scene.source is \"files\"", key));
      }
      image_io::Picture picture = read_input(config, "scene.image", files);
      in.colour = flipped(picture.image);
      in.colour_is_encoded = picture.srgb_encoded;
      in.depth_is_distance = config.text("scene.depth_encoding") == "metres";
      in.depth = in.depth_is_distance ? read_depth(config, in.colour, files) : stored(config, "scene.depth_image", files);
    } else {
      for (const char* key : {"scene.image", "scene.depth_image"}) {
        if (!config.text(key).empty())
          throw Error(ExitCode::usage, fmt::format("{}: needs scene.source = \"files\", found \"{}\"", key, source));
      }
      in.depth_is_distance = true;
      const scene::Camera camera = edge_splash::camera(s);
      if (source == "street") {
        night_street::Street::View view = night_street::Street({s.seed}).view(camera, s.width, s.height, s.depth.far_plane, executor);
        in.colour = std::move(view.colour);
        in.depth = std::move(view.depth);
      } else {
        edge_splash::ShapesView view = edge_splash::render_shapes(camera, s.width, s.height, s.depth.far_plane, executor);
        in.colour = std::move(view.colour);
        in.depth = std::move(view.depth);
      }
      // A camera may stand closer to something than the near plane, which would have cut it away.
      for (int y = 0; y < in.depth.height(); ++y) {
        for (int x = 0; x < in.depth.width(); ++x) {
          float& z = in.depth.row<float>(y)[x];
          if (z < s.depth.near_plane) z = static_cast<float>(s.depth.far_plane);
        }
      }
    }
    if (!config.text("scene.noise_image").empty()) in.noise = stored(config, "scene.noise_image", files);
    if (s.variant == Variant::corrected && !config.text("scene.layer_image").empty()) in.layer = stored(config, "scene.layer_image", files);
    return in;
  }
  static Image stored(const scene::Config& config, const std::string& key, std::vector<InputFile>& files) {
    return flipped(read_input(config, key, files).image);
  }

  edge_splash::EdgeSplash effect_;
};

}  // namespace

EffectEntry edge_splash_entry() {
  return {
      "edge_splash",
      {"as-published", "corrected"},
      edge_splash::parameters(),
      &edge_splash::effect_info(),
      [](const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs) -> std::unique_ptr<Simulation> {
        return std::make_unique<EdgeSplashSimulation>(config, executor, inputs);
      },
      edge_splash_memory};
}

}  // namespace rainref::cli
