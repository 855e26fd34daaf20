#include "windshield/instance.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

#include <fmt/format.h>

#include "math/half.h"
#include "windshield/info.h"
#include "windshield/scene/street.h"
#include "windshield/shown.h"

namespace rainref::windshield {
namespace {

effect::RunMemory memory_of(const scene::Config& config) {
  const Settings s = settings_from(config);
  const std::array<int, 2> scene = effect::is_named(config, "scene.image") ? s.scene_size : std::array{0, 0};
  effect::RunMemory m{fmt::format("run.size {}x{} with scene.size {}x{} and windshield.height_size {}x{} for {} drops", s.picture.width,
                                  s.picture.height, s.scene_size[0], s.scene_size[1], s.surface.width, s.surface.height, s.drops.capacity),
                      memory(s, static_cast<int>(config.integer("run.frames")), scene),
                      s.picture.width,
                      s.picture.height,
                      8,
                      6};
  const std::size_t texels = static_cast<std::size_t>(scene[0]) * static_cast<std::size_t>(scene[1]);
  if (effect::is_moving(config.text("scene.image")) || effect::is_moving(config.text("scene.depth_image")))
    m.peak.pass(texels * (3 * 16 + 3 * 4 + 8));  // decoded, flipped, and as inputs of the passes
  return m;
}

/// The pictures of a frame as inputs of the passes; empty if none is named.
Surroundings pictures_of(const effect::ScenePictures& named, int frame, effect::Inputs& files) {
  Surroundings s;
  if (!named.are_named()) return s;
  effect::ScenePictures::Seen seen = named.in(frame, street_far, files);
  s = surroundings_of(seen.colour);
  s.depth = std::move(seen.depth);
  return s;
}

std::unique_ptr<effect::Instance> open_scene(const scene::Config& config, const parallel::Executor& executor, effect::Inputs& inputs) {
  const Settings settings = settings_from(config);
  effect::ScenePictures named(config, true, {settings.scene_size, {settings.picture.width, settings.picture.height}}, inputs);
  Surroundings first = pictures_of(named, 0, inputs);
  if (!named.are_named()) first.street = street_of(settings, inputs);
  return std::make_unique<Instance>(config, std::move(first), std::move(named), executor);
}

}  // namespace

Surroundings surroundings_of(const Image& linear) {
  Surroundings s;
  s.colour = Image(Format::rgba16f, linear.width(), linear.height());
  s.depth = Image(Format::r32f, linear.width(), linear.height());
  for (int y = 0; y < linear.height(); ++y) {
    const float* from = linear.row<float>(y);
    Half* to = s.colour.row<Half>(y);
    for (int i = 0; i < 4 * linear.width(); ++i) to[i] = to_half(i % 4 == 3 ? 1.0f : std::clamp(from[i], 0.0f, 65504.0f));
    std::fill_n(s.depth.row<float>(y), linear.width(), static_cast<float>(street_far));
  }
  return s;
}

std::shared_ptr<const scene::Scenery> street_of(const Settings& settings, const effect::Inputs& inputs) {
  return effect::street_of(inputs, {settings.seed, settings.clear_lane});
}

Instance::Instance(const scene::Config& config, Surroundings surroundings, effect::ScenePictures named, const parallel::Executor& executor)
    : InstanceOf(config, std::move(surroundings), executor),
      settings_(settings_from(config)),
      named_(std::move(named)),
      shown_(named_.shown_in(0)) {}

void Instance::show_pictures_of(int frame) {
  const effect::ScenePictures::Shown wanted = named_.shown_in(frame);
  if (wanted == shown_) return;
  effect::Inputs none;
  changed().show(pictures_of(named_, frame, none));
  shown_ = wanted;
}

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
std::optional<effect::Display> Instance::display() const { return effect::Display{&running().colour(), settings_.picture.exposure}; }

effect::DropsLayer Instance::drops_layer(const parallel::Executor& executor) const {
  const PictureSettings& p = settings_.picture;
  const double half_height = camera(p).half_height(), half_width = half_height * p.width / p.height;
  const ShownScene scene(settings_, running());
  Image before;
  if (settings_.interior.on) before = draw_interior(settings_.interior, p, settings_.corners, executor);
  return effect::drops_layer(running().colour(), running().without_drops(), executor, [&](int column, int row) -> effect::DropPixel {
    const Shown shown = scene.at(column, row);
    if (!shown.is_on_glass) return {};
    const double open = before.empty() ? 1 : 1 - to_float(before.row<Half>(row)[4 * column + 3]);
    const double x = (2 * (column + 0.5) / p.width - 1) * half_width, y = (2 * (row + 0.5) / p.height - 1) * half_height;
    return {open * shown.visibility, (shown.x - x) / (2 * half_width), (shown.y - y) / (2 * half_height)};
  });
}

effect::Effect entry() {
  const std::vector<std::string> view{"seed",        "scene.clear_lane", "scene.size",    "scene.margin",           "scene.start",
                                      "scene.moves", "camera.position",  "camera.target", "camera.vertical_fov_deg"};
  return {"windshield",
          {"as-published", "corrected"},
          parameters(),
          &effect_info(),
          memory_of,
          open_scene,
          {{"street", {"seed", "scene.clear_lane"}},
           {"night_street view", view},
           {"windshield view", effect::joined(view, {"scene.keyframes"})},
           {"picture", {"scene.image", "scene.depth_image", "sequence.first"}},
           {"linear picture", {"scene.image", "scene.size", "run.size", "run.supersample"}},
           {"depth picture", {"scene.depth_image", "scene.depth_scale", "scene.size", "run.size", "run.supersample"}}}};
}

}  // namespace rainref::windshield
