#include "puddle/instance.h"

#include <fmt/format.h>

#include "image/flipped.h"
#include "night_street/memory.h"
#include "night_street/night_street.h"
#include "puddle/evaluations.h"
#include "puddle/info.h"
#include "puddle/memory.h"
#include "puddle/parameters.h"

namespace rainref::puddle {
namespace {

Surroundings surroundings(const scene::Config& config, const parallel::Executor& executor, effect::Inputs& inputs) {
  Surroundings s;
  if (config.text("environment.image").empty()) {
    const auto [width, height] = PictureSizes().environment;
    s.environment = night_street::Street().panorama(width, height, {0, 0.05, 0}, executor);
  } else {
    image_io::Picture picture = effect::read_input(config, "environment.image", inputs);
    s.environment_is_cube = config.text("environment.layout") == "cube";
    // A panorama's v = 0 looks down; a cube's faces start at their top row, as graphics APIs have it.
    s.environment = s.environment_is_cube ? std::move(picture.image) : flipped(picture.image);
    s.environment_is_encoded = picture.srgb_encoded;
  }
  if (!config.text("puddle.ground_image").empty()) {
    image_io::Picture picture = effect::read_input(config, "puddle.ground_image", inputs);
    s.ground = flipped(picture.image);
    s.ground_is_encoded = picture.srgb_encoded;
  }
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
  if (effect::is_named(config, "environment.image"))
    sizes.environment = {1, 1};
  else
    m.peak.then(night_street::panorama_memory(sizes.environment[0], sizes.environment[1]));
  if (effect::is_named(config, "puddle.ground_image")) sizes.ground = {1, 1};
  m.peak.then(memory(s, sizes));
  return m;
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

effect::Effect entry() {
  return {"puddle",
          {"as-published", "corrected"},
          parameters(),
          &effect_info(),
          &evaluations(),
          memory_of,
          [](const scene::Config& config, const parallel::Executor& executor, effect::Inputs& inputs) -> std::unique_ptr<effect::Instance> {
            return std::make_unique<Instance>(settings_from(config), surroundings(config, executor, inputs), executor);
          }};
}

}  // namespace rainref::puddle
