#include "rainy_glass/instance.h"

#include <fmt/format.h>

#include "parallel/rows.h"
#include "rainref/error.h"
#include "rainy_glass/backdrop.h"
#include "rainy_glass/info.h"
#include "rainy_glass/host.h"
#include "rainy_glass/parameters.h"
#include "rainy_glass/shown.h"
#include "scene/scenery_memory.h"

namespace rainref::rainy_glass {
namespace {

Surroundings surroundings_of(const scene::Config& config, const Settings& settings, const effect::ScenePictures& named,
                             const parallel::Executor& executor, effect::Inputs& inputs) {
  if (settings.shape != Shape::image) effect::refuse_unused(config, "glass.normal_image", "glass.shape");
  if (!settings.use_probe) effect::refuse_unused(config, "glass.probe_image", "glass.background");
  const Image panorama = effect::read_panorama(config, inputs);
  Surroundings s;
  if (named.are_named()) {
    effect::ScenePictures::Seen seen = named.in(0, backdrop_far, inputs);
    s.colour = std::move(seen.colour);
    s.depth = std::move(seen.depth);
  } else {
    Settings seen = settings;
    seen.use_probe = settings.use_probe && config.text("glass.probe_image").empty();
    s = panorama.empty() ? make_backdrop(seen, backdrop_from(config), *effect::street_of(inputs, {settings.seed}), executor)
                         : make_backdrop(seen, backdrop_from(config), panorama, executor);
  }
  if (settings.use_probe && s.probe.empty()) {
    if (config.text("glass.probe_image").empty())
      throw Error(ExitCode::usage, "glass.probe_image: expected a panorama beside scene.image, found none");
    s.probe = effect::read_linear(config, "glass.probe_image", inputs);
  }
  if (settings.shape == Shape::image) {
    if (config.text("glass.normal_image").empty())
      throw Error(ExitCode::usage, "glass.normal_image: expected a picture for glass.shape = \"image\", found none");
    const image_io::Picture p = effect::read_input(config, "glass.normal_image", inputs);
    const bool is_code = info(p.image.format()).kind == FormatInfo::unorm8 || p.srgb_encoded;
    s.normals = effect::floats_of(p, [&](float x, int c) { return c < 3 && is_code ? 2 * x - 1 : x; });
  }
  if (!config.text("maps.raindrops_image").empty()) s.raindrops = effect::read_tile(config, "maps.raindrops_image", true, inputs);
  if (!config.text("maps.rivulets_image").empty()) s.rivulets = effect::read_tile(config, "maps.rivulets_image", true, inputs);
  return s;
}

effect::RunMemory memory_of(const scene::Config& config) {
  const Settings s = settings_from(config);
  effect::RunMemory m{
      fmt::format("run.size {}x{} with maps.size {}", s.width, s.height, s.map_size), {}, s.width, s.height, 8 + 8 + 16, 6 + 6 + 12};
  const std::size_t colour = image_bytes(m, Format::rgba32f), depth = image_bytes(m, Format::r32f);
  if (effect::is_named(config, "scene.image") || effect::is_named(config, "scene.panorama")) {
    m.peak.hold(colour + depth);
  } else {
    m.peak.then(scene::view_memory(s.width, s.height));
    if (s.use_probe) m.peak.then(scene::panorama_memory(1024, 512));
  }
  m.peak.pass(colour);                                    // out of focus
  m.peak.pass(colour + image_bytes(m, Format::rgba16f));  // the glass, for its bars
  m.peak.then(memory(s));
  if (effect::is_moving(config.text("scene.image"))) m.peak.pass(3 * colour + 3 * depth);  // decoded, flipped, and as input of the pass
  return m;
}

std::unique_ptr<effect::Instance> open_scene(const scene::Config& config, const parallel::Executor& executor, effect::Inputs& inputs) {
  const Settings settings = settings_from(config);
  const Size size{settings.width, settings.height};
  effect::ScenePictures named(config, settings.variant == Variant::corrected, {size, size}, inputs);
  Surroundings around = surroundings_of(config, settings, named, executor, inputs);
  return std::make_unique<Instance>(settings, std::move(around), std::move(named), executor);
}

}  // namespace

Instance::Instance(const Settings& settings, Surroundings surroundings, effect::ScenePictures named, const parallel::Executor& executor)
    : InstanceOf(settings, surroundings, executor),
      named_(std::move(named)),
      shown_(named_.shown_in(0)),
      settings_(settings),
      surroundings_(std::move(surroundings)) {}

void Instance::show_pictures_of(int frame) {
  const effect::ScenePictures::Shown wanted = named_.shown_in(frame);
  if (wanted == shown_) return;
  effect::Inputs none;
  effect::ScenePictures::Seen seen = named_.in(frame, backdrop_far, none);
  surroundings_.colour = std::move(seen.colour);
  surroundings_.depth = std::move(seen.depth);
  changed().show(surroundings_.colour, surroundings_.depth);
  shown_ = wanted;
}

std::vector<PassOutput> Instance::buffers() {
  const RainyGlass& g = running();
  return {{"raindrops", g.raindrops()},     {"rivulets", g.rivulets()}, {"surface", g.surface()},
          {"orientation", g.orientation()}, {"colour", g.colour()},     {"picture", g.picture()}};
}
std::vector<image_io::Layer> Instance::layers() const {
  const RainyGlass& g = running();
  return {{"", {"R", "G", "B"}, &g.colour()}, {"normal", {"X", "Y", "Z"}, &g.orientation()}, {"glass", {"U", "V", "Z"}, &g.surface()}};
}
std::optional<effect::Display> Instance::display() const { return effect::Display{&running().colour(), settings_.exposure}; }

effect::DropsLayer Instance::drops_layer(const parallel::Executor& executor) const {
  const ShownGlass glass(settings_, surroundings_, running());
  const std::array<double, 2> half = glass.half_size();
  return effect::drops_layer(running().colour(), colour_as_half(surroundings_.colour, parallel::rows_of(executor)), executor,
                             [&](int column, int row) -> effect::DropPixel {
                               const Shown shown = glass.at(column, row);
                               if (!shown.is_behind || !shown.is_wet) return {};
                               return {1, 0.5 * shown.x / half[0] - (column + 0.5) / settings_.width + 0.5,
                                       0.5 * shown.y / half[1] - (row + 0.5) / settings_.height + 0.5};
                             });
}

effect::Effect entry() {
  const std::vector<std::string> camera{"run.size",      "run.supersample", "camera.position",
                                        "camera.target", "camera.up",       "camera.vertical_fov_deg"};
  const std::vector<std::string> pane = effect::joined(camera, {"glass.shape", "glass.distance", "glass.yaw", "glass.radius"});
  const std::vector<std::string> behind{"seed", "scene.panorama", "scene.bar_spacing", "scene.bar_width"};
  const std::vector<std::string> barred = effect::joined(effect::joined(camera, {"glass.shape", "glass.distance", "glass.yaw"}), behind);
  const std::vector<std::string> droplets{"seed", "maps.size", "maps.droplets", "maps.largest_droplet", "maps.smallest_droplet"};
  const std::vector<std::string> trails{"seed", "maps.trails", "maps.trail_half_width"};
  const std::vector<std::string> stored{"maps.storage", "maps.rounding", "maps.contact_angle"};
  const std::vector<std::string> raindrops = effect::joined(droplets, stored);
  const std::vector<std::string> rivulets =
      effect::joined(effect::joined(trails, stored), {"maps.size", "maps.flow_cells", "maps.flow_gain"});
  return {"rainy_glass",
          {"as-published", "corrected"},
          parameters(),
          &effect_info(),
          memory_of,
          open_scene,
          {{"street", {"seed"}},
           {"night_street view", effect::joined(camera, {"seed"})},
           {"night_street panorama", {"seed", "glass.background", "camera.position"}},
           {"picture",
            {"scene.image", "scene.depth_image", "scene.panorama", "glass.normal_image", "glass.probe_image", "maps.raindrops_image",
             "maps.rivulets_image"}},
           {"linear picture", {"run.size", "run.supersample", "scene.image", "scene.panorama", "glass.probe_image"}},
           {"depth picture", {"run.size", "run.supersample", "scene.depth_image", "scene.depth_scale"}},
           {"panorama view", effect::joined(camera, {"scene.panorama"})},
           {"rainy_glass street", effect::joined(camera, {"seed", "scene.defocus"})},
           {"rainy_glass panorama", effect::joined(camera, {"scene.panorama", "scene.defocus"})},
           {"rainy_glass bars", effect::joined(effect::joined(pane, behind), {"scene.defocus"})},
           {"rainy_glass scene", effect::joined(barred, {"scene.image", "scene.defocus"})},
           {"rainy_glass near depth", effect::joined(barred, {"scene.image", "scene.depth", "scene.depth_image", "scene.depth_scale"})},
           {"rainy_glass probe", {"seed", "glass.background", "glass.probe_image", "camera.position", "scene.panorama"}},
           {"rainy_glass surface", effect::joined(pane, {"glass.normal_image"})},
           {"rainy_glass droplets", droplets},
           {"rainy_glass trails", trails},
           {"rainy_glass lattice", {"seed", "maps.flow_cells"}},
           {"rainy_glass raindrops", raindrops},
           {"rainy_glass raindrops decoded", effect::joined(raindrops, {"maps.raindrops_image"})},
           {"rainy_glass rivulets", rivulets},
           {"rainy_glass rivulets decoded", effect::joined(rivulets, {"maps.rivulets_image"})}}};
}

}  // namespace rainref::rainy_glass
