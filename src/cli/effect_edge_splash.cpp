#include <cstring>

#include <fmt/format.h>

#include "base/read_file.h"
#include "capture/hashing.h"
#include "capture/npy_read.h"
#include "cli/effects.h"
#include "cli/inputs.h"
#include "cli/pictures.h"
#include "edge_splash/host.h"
#include "edge_splash/info.h"
#include "edge_splash/parameters.h"
#include "edge_splash/shapes.h"
#include "image_io/write.h"
#include "math/half.h"
#include "night_street/night_street.h"
#include "rainref/edge_splash.h"
#include "rainref/error.h"

namespace rainref::cli {
namespace {

void require_finite(const Image& image, const std::string& file) {
  for (int y = image.height() - 1; y >= 0; --y) {
    for (int x = 0; x < image.width(); ++x) {
      const float value = image.format() == Format::r32f ? image.row<float>(y)[x] : image.format() == Format::r16f ? to_float(image.row<Half>(y)[x]) : 0.0f;
      if (!(value - value == 0)) throw Error(ExitCode::usage, fmt::format("{}: expected finite numbers, found {} at column {}, row {}", file, value, x, image.height() - 1 - y));
    }
  }
}
/// A .npy file of (height, width) or (height, width, 1) numbers, top row first, as r32f, r16f or r8 from the bottom up.
Image read_npy(const scene::Config& config, const std::string& key, std::vector<InputFile>& inputs) {
  std::filesystem::path path = config.text(key);
  if (path.is_relative() && config.entry(key).origin.kind == scene::Origin::file) path = config.directory() / path;
  try {
    const std::vector<std::byte> bytes = read_file(path);
    const capture::NpyHeader header = capture::parse_npy_header(bytes, path.string());
    const bool is_plane = header.shape.size() == 2 || (header.shape.size() == 3 && header.shape[2] == 1);
    if (!is_plane || header.type.empty() || header.type == "<u4") {
      throw Error(ExitCode::usage, fmt::format("{}: expected (height, width) numbers of type <f4, <f2 or |u1", path.string()));
    }
    const Format format = header.type == "<f4" ? Format::r32f : header.type == "<f2" ? Format::r16f : Format::r8;
    const std::size_t width = header.shape[1], height = header.shape[0];
    if (width > 65536 || height > 65536) throw Error(ExitCode::usage, fmt::format("{}: expected sides up to 65536, found {}x{}", path.string(), width, height));
    Image image(format, static_cast<int>(width), static_cast<int>(height));
    const std::size_t row = width * header.record_bytes;
    for (std::size_t y = 0; y < height; ++y) std::memcpy(image.row_bytes(static_cast<int>(height - 1 - y)), bytes.data() + header.data_offset + y * row, row);
    require_finite(image, path.string());
    inputs.push_back({key, config.text(key), capture::hash_of(BufferView(image)).text(), false});
    return image;
  } catch (const Error& e) {
    throw Error(e.code() == ExitCode::port_files ? ExitCode::usage : e.code(), fmt::format("{}: {}", key, e.what()));
  }
}
bool is_npy(const std::string& path) { return path.size() > 4 && path.substr(path.size() - 4) == ".npy"; }

class EdgeSplashSimulation : public Simulation {
 public:
  EdgeSplashSimulation(const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& files)
      : effect_(edge_splash::settings_from(config), pictures(config, executor, files), executor) {
    for (const std::string& warning : effect_.warnings()) fmt::print(stderr, "rainref: warning: {}\n", warning);
  }

  void frame(Recorder* recorder) override { effect_.render(recorder); }
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
        if (config.text(key).empty()) throw Error(ExitCode::usage, fmt::format("{}: expected a file, because scene.source is \"files\"", key));
      }
      image_io::Picture picture = read_input(config, "scene.image", files);
      in.colour = flipped(picture.image);
      in.colour_is_encoded = picture.srgb_encoded;
      in.depth = first_channel_file(config, "scene.depth_image", files);
      in.depth_is_distance = config.text("scene.depth_encoding") == "metres";
    } else {
      for (const char* key : {"scene.image", "scene.depth_image"}) {
        if (!config.text(key).empty()) throw Error(ExitCode::usage, fmt::format("{}: needs scene.source = \"files\", found \"{}\"", key, source));
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
    if (!config.text("scene.noise_image").empty()) in.noise = first_channel_file(config, "scene.noise_image", files);
    if (s.variant == edge_splash::Variant::corrected && !config.text("scene.layer_image").empty()) in.layer = first_channel_file(config, "scene.layer_image", files);
    return in;
  }
  static Image first_channel_file(const scene::Config& config, const std::string& key, std::vector<InputFile>& files) {
    if (is_npy(config.text(key))) return read_npy(config, key, files);
    return flipped(read_input(config, key, files).image);
  }

  edge_splash::EdgeSplash effect_;
};

}  // namespace

EffectEntry edge_splash_entry() {
  return {"edge_splash", {"as-published", "corrected"}, edge_splash::parameters(), &edge_splash::effect_info(),
          [](const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs) -> std::unique_ptr<Simulation> {
            return std::make_unique<EdgeSplashSimulation>(config, executor, inputs);
          }};
}

}  // namespace rainref::cli
