#include "screen_drops/instance.h"

#include <algorithm>

#include <fmt/format.h>

#include "effect/scene_pictures.h"
#include "image/flipped.h"
#include "scene/panorama_view.h"
#include "scene/scenery_memory.h"
#include "screen_drops/flow.h"
#include "screen_drops/host.h"
#include "screen_drops/info.h"
#include "screen_drops/parameters.h"
#include "screen_drops/shown.h"

namespace rainref::screen_drops {
namespace {

constexpr double street_far = 1000;  // depth of its sky [m]; unused

Inputs pictures(const scene::Config& config, const Settings& settings, const effect::ScenePictures& named,
                const parallel::Executor& executor, effect::Inputs& files) {
  Inputs in;
  const Image panorama = effect::read_panorama(config, files);
  if (!panorama.empty()) {
    in.colour = scene::panorama_view(panorama, scene_camera(settings), settings.width, settings.height, executor);
  } else if (named.are_named()) {
    in.colour = named.in(0, street_far, files).colour;
  } else {
    const auto street = effect::street_of(files, {settings.seed});
    in.colour = street->view(scene_camera(settings), settings.width, settings.height, street_far, executor).colour;
  }
  if (settings.variant == Variant::as_published && !config.text("noise.image").empty())
    in.noise = effect::read_tile(config, "noise.image", false, files);
  return in;
}

effect::RunMemory memory_of(const scene::Config& config) {
  const Settings s = settings_from(config);
  effect::RunMemory m{fmt::format("run.size {}x{}", s.width, s.height), {}, s.width, s.height, 8 + 8, 6 + 6};
  if (effect::is_named(config, "scene.image") || effect::is_named(config, "scene.panorama")) {
    m.peak.hold(image_bytes(m, Format::rgba32f));
  } else {
    m.peak.then(scene::view_memory(s.width, s.height));
    m.peak.release(image_bytes(m, Format::r32f));
  }
  const std::optional<FlowSettings> flow = flow_from(config, s);
  m.peak.then(memory(s, flow ? &*flow : nullptr, flow ? flow->warm_up + static_cast<double>(config.integer("run.frames")) / s.fps : 0));
  if (effect::is_moving(config.text("scene.image"))) m.peak.pass(4 * image_bytes(m, Format::rgba32f));  // decoded, flipped, and its mips
  return m;
}

std::unique_ptr<effect::Instance> open_scene(const scene::Config& config, const parallel::Executor& executor, effect::Inputs& inputs) {
  const Settings settings = settings_from(config);
  check(settings);
  const Size size{settings.width, settings.height};
  effect::ScenePictures named(config, false, {size, size}, inputs);
  Inputs seen = pictures(config, settings, named, executor, inputs);
  const std::optional<FlowSettings> flow = flow_from(config, settings);
  return std::make_unique<Instance>(settings, std::move(seen), std::move(named), flow ? &*flow : nullptr, executor);
}

}  // namespace

Instance::Instance(const Settings& settings, Inputs pictures, effect::ScenePictures named, const FlowSettings* flow,
                   const parallel::Executor& executor)
    : InstanceOf(settings, pictures, executor, flow), named_(std::move(named)), settings_(settings), pictures_(std::move(pictures)) {}

// Each frame's background is a run of its own, so that the record of a frame does not depend on earlier frames.
void Instance::show_pictures_of(int frame) {
  if (!named_.change() || (frame == shown_ && frame == held_)) return;
  effect::Inputs none;
  pictures_.colour = named_.in(frame, street_far, none).colour;
  if (frame == shown_)
    changed().show_again(pictures_.colour);
  else
    changed().show(pictures_.colour);
  shown_ = held_ = frame;
}

void Instance::list_state(state::Items& items) {
  InstanceOf::list_state(items);
  if (named_.change()) items.number("shown", shown_, state::frames);
}

std::vector<PassOutput> Instance::buffers() {
  const ScreenDrops& s = running();
  std::vector<PassOutput> all{{"background", s.background()}};
  if (settings_.variant == Variant::corrected) {
    all.push_back({"cells", s.cells()});
    all.push_back({"height", s.height()});
  }
  for (const PassOutput& image : std::initializer_list<PassOutput>{{"water", s.water()}, {"colour", s.colour()}, {"picture", s.picture()}})
    all.push_back(image);
  return all;
}
std::vector<image_io::Layer> Instance::layers() const {
  return {{"", {"R", "G", "B"}, &running().colour()}, {"background", {"R", "G", "B"}, &running().background()}};
}
std::optional<effect::Display> Instance::display() const { return effect::Display{&running().colour(), settings_.exposure}; }

effect::DropsLayer Instance::drops_layer(const parallel::Executor& executor) const {
  const ShownDrops drops(settings_, running());
  const std::array<double, 2> half = drops.half_size();
  return effect::drops_layer(running().colour(), copy_of(running().background()), executor, [&](int column, int row) -> effect::DropPixel {
    const Shown shown = drops.at(column, row);
    const double z = std::max(shown.bent.z, 0.05);  // as in the pass
    return {shown.cover, 0.5 * shown.bent.x / (z * half[0]) - (column + 0.5) / settings_.width + 0.5,
            0.5 * shown.bent.y / (z * half[1]) - (row + 0.5) / settings_.height + 0.5};
  });
}

std::optional<std::vector<effect::DropDisc>> Instance::drop_discs() const {
  if (settings_.variant != Variant::corrected) return std::nullopt;
  std::vector<effect::DropDisc> discs;
  for (const Cap& cap : shown_caps(settings_, running().cells()))
    discs.push_back({cap.x / settings_.pane_height, cap.y / settings_.pane_height, cap.radius / settings_.pane_height});
  return discs;
}

effect::Effect entry() {
  const std::vector<std::string> camera{"run.size",  "run.supersample",         "camera.position", "camera.target",
                                        "camera.up", "camera.vertical_fov_deg", "scene.margin"};
  const std::vector<std::string> seen = effect::joined(camera, {"seed", "scene.image", "scene.panorama"});
  return {"screen_drops",
          {"as-published", "corrected"},
          parameters(),
          &effect_info(),
          memory_of,
          open_scene,
          {{"street", {"seed"}},
           {"night_street view", effect::joined(camera, {"seed"})},
           {"picture", {"scene.image", "scene.panorama", "noise.image"}},
           {"linear picture", {"run.size", "run.supersample", "scene.image", "scene.panorama"}},
           {"panorama view", effect::joined(camera, {"scene.panorama"})},
           {"screen_drops levels", seen},
           {"screen_drops background", effect::joined(seen, {"background.level", "background.defocus", "drops.rounding", "scene.wrap"})},
           {"screen_drops noise", {"seed", "noise.size", "noise.image"}},
           {"screen_drops warm-up",
            {"seed",
             "run.fps",
             "run.size",
             "rain.rate",
             "rain.smallest_drop",
             "rain.wind",
             "world.gravity",
             "glass.height",
             "flow.on",
             "flow.advancing_angle",
             "flow.capacity",
             "flow.film_drying",
             "flow.height_size",
             "flow.humidity",
             "flow.lifetime",
             "flow.margin",
             "flow.mobility",
             "flow.neck_time",
             "flow.receding_angle",
             "flow.substeps",
             "flow.trail_thickness",
             "flow.warm_up"}}}};
}

}  // namespace rainref::screen_drops
