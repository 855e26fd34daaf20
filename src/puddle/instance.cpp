#include "puddle/instance.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "image/flipped.h"
#include "math/constants.h"
#include "math/real64.h"
#include "puddle/info.h"
#include "puddle/host.h"
#include "puddle/parameters.h"
#include "scene/camera.h"
#include "scene/scenery_memory.h"

namespace rainref::puddle {
namespace {

/// Columns and rows of the panorama of the street: as given, or the largest power of two in [1024, 4096] below one column per pixel at the
/// centre of the picture. Coarser panoramas show the road beyond the puddle out of focus.
std::array<int, 2> street_size(const scene::Config& config) {
  int width = static_cast<int>(config.integer("environment.width"));
  if (width == 0) {
    const Settings s = settings_from(config);
    scene::Camera camera;
    camera.vertical_fov_deg = s.vertical_fov_deg;
    const double pixel = 2 * camera.half_height() / s.height * static_cast<double>(config.integer("run.supersample"));  // [rad]
    for (width = 1024; width < 4096 && 2 * width * pixel <= 2 * pi;) width *= 2;
  }
  return {width, std::max(1, width / 2)};
}

/// Viewpoint in the street. corrected: the camera's position in it, so that the road beyond the puddle appears where its rays meet the
/// ground. as published, and for a camera outside the street: over the centre of the puddle.
scene::Vector3 street_eye(const Settings& s) {
  constexpr double lowest = 0.05, widest = 7, farthest = 280;  // inside the facades and the street's ends
  const auto& [x, y, z] = s.camera_position;
  const double c = cos_real(Real64(s.env_rotation)).v, n = sin_real(Real64(s.env_rotation)).v;
  const scene::Vector3 eye{c * x + n * z, std::max(y, lowest), c * z - n * x};  // the shade pass's rotate
  if (s.variant != Variant::corrected || std::abs(eye.x) > widest || std::abs(eye.z) > farthest) return {0, lowest, 0};
  return eye;
}

Surroundings surroundings(const scene::Config& config, const parallel::Executor& executor, effect::Inputs& inputs) {
  Surroundings s;
  if (config.text("environment.image").empty()) {
    const auto [width, height] = street_size(config);
    s.environment = effect::street_of(inputs, {})->panorama(width, height, street_eye(settings_from(config)), executor);
  } else {
    image_io::Picture picture = effect::read_input(config, "environment.image", inputs);
    s.environment_is_cube = config.text("environment.layout") == "cube";
    // A panorama's v = 0 looks down; the faces of a cube start at their top row, as in graphics APIs.
    s.environment = s.environment_is_cube ? std::move(picture.image) : flipped(picture.image);
    s.environment_is_encoded = picture.srgb_encoded;
  }
  if (!config.text("puddle.ground_image").empty()) {
    image_io::Picture picture = effect::read_input(config, "puddle.ground_image", inputs);
    s.ground = flipped(picture.image);
    s.ground_is_encoded = picture.srgb_encoded;
  }
  if (config.variant() == "corrected" && effect::is_named(config, "rain.shelter_image"))
    s.shelter = flipped(effect::read_input(config, "rain.shelter_image", inputs).image);
  return s;
}

effect::RunMemory memory_of(const scene::Config& config) {
  const Settings s = settings_from(config);
  const std::array<int, 2> grid = s.variant == Variant::corrected ? s.grid : std::array{s.width, s.height};
  effect::RunMemory m{fmt::format("run.size {}x{} with a wave of {}x{}", s.width, s.height, grid[0], grid[1]),
                      {},
                      s.width,
                      s.height,
                      8 + 8 + 16,
                      6 + 6 + 12};
  PictureSizes sizes;
  sizes.environment = street_size(config);
  if (effect::is_named(config, "environment.image")) {
    sizes.environment = {1, 1};
  } else {
    sizes.has_float_environment = true;
    m.peak.then(scene::panorama_memory(sizes.environment[0], sizes.environment[1]));
  }
  if (effect::is_named(config, "puddle.ground_image")) sizes.ground = {1, 1};
  m.peak.then(memory(s, sizes));
  return m;
}

std::unique_ptr<effect::Instance> open_scene(const scene::Config& config, const parallel::Executor& executor, effect::Inputs& inputs) {
  return std::make_unique<Instance>(settings_from(config), surroundings(config, executor, inputs), executor);
}

}  // namespace

Instance::Instance(const Settings& settings, Surroundings surroundings, const parallel::Executor& executor)
    : InstanceOf(settings, surroundings, executor), settings_(settings), surroundings_(std::move(surroundings)) {}

std::vector<PassOutput> Instance::buffers() {
  const Puddle& p = running();
  return {{"wave", p.wave()}, {"hit", p.hit()}, {"normal", p.normal()}, {"colour", p.colour()}, {"picture", p.picture()}};
}
std::vector<image_io::Layer> Instance::layers() const {
  const Puddle& p = running();
  return {{"", {"R", "G", "B"}, &p.colour()}, {"normal", {"X", "Y", "Z"}, &p.normal()}, {"position", {"X", "Y", "Z"}, &p.hit()}};
}
std::optional<effect::Display> Instance::display() const {
  const bool corrected = settings_.variant == Variant::corrected;
  return effect::Display{&running().colour(), corrected ? settings_.exposure : 0, settings_.vignette,
                         corrected ? effect::Display::Code::srgb : effect::Display::Code::power};
}

effect::Effect entry() {
  // Inputs of the view of the street if environment.width is 0.
  const std::vector<std::string> panorama{"environment.width", "puddle.env_rotation", "run.size",
                                          "run.supersample",   "camera.position",     "camera.vertical_fov_deg"};
  const std::vector<std::string> depths{
      "seed", "puddle.shape", "puddle.grid", "puddle.cell_size", "puddle.puddle_depth", "puddle.bed_columns"};
  return {"puddle",
          {"as-published", "corrected"},
          parameters(),
          &effect_info(),
          memory_of,
          open_scene,
          {{"night_street panorama", panorama},
           {"picture", {"environment.image", "puddle.ground_image", "rain.shelter_image"}},
           {"puddle sky", effect::joined(panorama, {"environment.image", "environment.layout"})},
           {"puddle asphalt", {"seed", "puddle.use_checkerboard"}},
           {"puddle ground", {"seed", "puddle.ground_image", "puddle.use_checkerboard"}},
           {"puddle depths", depths},
           {"puddle bed", effect::joined(depths, {"puddle.shore_width"})},
           {"puddle display", {"puddle.rounding"}}}};
}

}  // namespace rainref::puddle
