#include "windshield/instance.h"

#include <initializer_list>
#include <utility>

#include <fmt/format.h>

#include "effect/scene_pictures.h"
#include "rainref/error.h"
#include "windshield/evaluations.h"
#include "windshield/info.h"
#include "windshield/memory.h"
#include "windshield/scene_images.h"

namespace rainref::windshield {
namespace {

Surroundings surroundings(const scene::Config& config, effect::Inputs& inputs) {
  Surroundings s;
  const bool has_depth = effect::is_named(config, "scene.depth_image");
  if (!effect::is_named(config, "scene.image")) {
    if (has_depth)
      throw Error(ExitCode::usage, config.entry("scene.depth_image").origin.at,
                  "scene.depth_image: expected scene.image beside it, found none");
    return s;
  }
  const Image colour = effect::read_linear(config, "scene.image", inputs);
  s.colour = opaque_half(colour);
  s.depth = has_depth ? effect::read_depth(config, colour, inputs) : far_depth(colour.width(), colour.height());
  return s;
}

effect::RunMemory memory_of(const scene::Config& config) {
  const Settings s = settings_from(config);
  return {
      fmt::format("run.size {}x{} with scene.size {}x{} and windshield.height_size {}x{} for {} drops", s.picture.width, s.picture.height,
                  s.scene_size[0], s.scene_size[1], s.surface.width, s.surface.height, s.drops.capacity),
      memory(s, static_cast<int>(config.integer("run.frames")), effect::is_named(config, "scene.image") ? s.scene_size : std::array{0, 0}),
      s.picture.width,
      s.picture.height,
      8,
      6};
}

}  // namespace

Instance::Instance(const scene::Config& config, Surroundings surroundings, bool has_street, const parallel::Executor& executor)
    : InstanceOf(config, std::move(surroundings), executor), settings_(settings_from(config)), has_street_(has_street) {}

std::vector<PassOutput> Instance::buffers() {
  const Windshield& w = running();
  if (std::exchange(drops_frame_, frame()) != frame()) {
    drops_.clear();
    for (const DropView& d : w.drops())
      drops_.push_back(
          {.position = {d.u, d.v}, .velocity = {d.velocity_u, d.velocity_v}, .mass = d.mass, .life = d.life, .id = d.id, .padding0 = 0});
  }
  std::vector<PassOutput> all{{"drops", RecordView{drops_.data(), drops_.size(), sizeof(drops::Drop)}}};
  if (settings_.corrected) all.push_back({"film", w.film()});
  for (const PassOutput& image : std::initializer_list<PassOutput>{
           {"height", w.height()}, {"mask", w.mask()}, {"normal", w.normal()}, {"colour", w.colour()}, {"picture", w.picture()}})
    all.push_back(image);
  return all;
}
std::vector<image_io::Layer> Instance::layers() const { return {{"", {"R", "G", "B"}, &running().colour()}}; }

effect::Effect entry() {
  return {"windshield",
          {"as-published", "corrected"},
          parameters(),
          &effect_info(),
          &evaluations(),
          memory_of,
          [](const scene::Config& config, const parallel::Executor& executor, effect::Inputs& inputs) -> std::unique_ptr<effect::Instance> {
            return std::make_unique<Instance>(config, surroundings(config, inputs), !effect::is_named(config, "scene.image"), executor);
          }};
}

}  // namespace rainref::windshield
