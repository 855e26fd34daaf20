#include "edge_splash/instance.h"

#include <algorithm>

#include <fmt/format.h>

#include "cache/prepared.h"
#include "edge_splash/host.h"
#include "edge_splash/info.h"
#include "edge_splash/parameters.h"
#include "edge_splash/shapes.h"
#include "image/flipped.h"
#include "math/unorm.h"
#include "rainref/error.h"
#include "scene/scenery_memory.h"

namespace rainref::edge_splash {
namespace {

/// A camera may be closer to an object than the near plane, which would have clipped it.
Image clipped(const int&, const Image& depth, const double& near_plane, const double& far_plane) {
  Image out = copy_of(depth);
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      float& z = out.row<float>(y)[x];
      if (z < near_plane) z = static_cast<float>(far_plane);
    }
  }
  return out;
}

Inputs pictures(const scene::Config& config, const Settings& s, const ScenePictures& named, const parallel::Executor& executor,
                effect::Inputs& files) {
  Inputs in;
  const std::string source = source_of(config);
  named.fill(0, in, files);
  if (source != "files") {
    in.depth_is_distance = true;
    const scene::Camera eye = camera(s);
    if (source == "street") {
      scene::Scenery::View view = effect::street_of(files, {s.seed})->view(eye, s.width, s.height, s.depth.far_plane, executor);
      in.colour = std::move(view.colour);
      in.depth = std::move(view.depth);
    } else {
      ShapesView view = render_shapes(eye, s.width, s.height, s.depth.far_plane, executor);
      in.colour = std::move(view.colour);
      in.depth = std::move(view.depth);
    }
    in.depth = cache::prepared("edge_splash clipped depth", 0, clipped, in.depth, s.depth.near_plane, s.depth.far_plane)->shared();
  }
  if (!config.text("scene.noise_image").empty()) in.noise = flipped(effect::read_input(config, "scene.noise_image", files).image);
  return in;
}

effect::RunMemory memory_of(const scene::Config& config) {
  const Settings s = settings_from(config);
  const bool has_codes = colour_format(s) == Format::rgba8;
  const std::uint64_t texel = (has_codes ? 16 : 8) + 4;  // radiance and depth
  effect::RunMemory m{fmt::format("run.size {}x{}", s.width, s.height), {}, s.width, s.height, texel, texel};
  const std::size_t inputs = image_bytes(m, Format::rgba32f) + image_bytes(m, Format::r32f);
  if (source_of(config) == "street") {
    m.peak.then(scene::view_memory(s.width, s.height));
  } else {
    m.peak.hold(inputs);
  }
  m.peak.then(memory(s));
  if (has_codes) m.peak.hold(image_bytes(m, Format::rgba32f));  // radiance
  m.peak.release(inputs);
  if (effect::is_moving(config.text("scene.image")) || effect::is_moving(config.text("scene.depth_image")))
    m.peak.pass(2 * inputs + image_bytes(m, Format::rgba32f));  // a picture as decoded, flipped, and as input of the pass
  return m;
}

std::unique_ptr<effect::Instance> open_scene(const scene::Config& config, const parallel::Executor& executor, effect::Inputs& inputs) {
  const Settings settings = settings_from(config);
  check(settings);
  ScenePictures named(config, {settings.width, settings.height}, inputs);
  const Inputs first = pictures(config, settings, named, executor, inputs);
  auto instance = std::make_unique<Instance>(settings, first, std::move(named), executor);
  for (const std::string& warning : instance->running().warnings()) inputs.warnings.push_back(warning);
  return instance;
}

}  // namespace

Instance::Instance(const Settings& settings, const Inputs& pictures, ScenePictures named, const parallel::Executor& executor)
    : InstanceOf(settings, pictures, executor), exposure_(settings.exposure), named_(std::move(named)), shown_(named_.shown_in(0)) {}

void Instance::show_pictures_of(int frame) {
  const ScenePictures::Shown wanted = named_.shown_in(frame);
  if (wanted == shown_) return;
  Inputs in;
  effect::Inputs none;
  named_.fill(frame, in, none);
  try {
    changed().show(in);
  } catch (const Error& e) {
    throw named_.about_depth(e, frame);
  }
  shown_ = wanted;
}

std::vector<PassOutput> Instance::buffers() {
  const EdgeSplash& e = running();
  return {{"edge", e.edge()}, {"angle", e.angle()}, {"noise", e.noise()}, {"colour", e.colour()}, {"picture", e.picture()}};
}
const Image& Instance::radiance() const {
  const Image& colour = running().colour();
  if (colour.format() != Format::rgba8) return colour;
  if (radiance_.empty()) radiance_ = Image(Format::rgba32f, colour.width(), colour.height());
  for (int y = 0; y < colour.height(); ++y) {
    const Unorm8* from = colour.row<Unorm8>(y);
    std::transform(from, from + 4 * colour.width(), radiance_.row<float>(y), [](Unorm8 code) { return to_float(code); });
  }
  return radiance_;
}
std::vector<image_io::Layer> Instance::layers() const {
  return {{"", {"R", "G", "B", "A"}, &radiance()}, {"depth", {"Z"}, &running().depth()}};
}
std::optional<effect::Display> Instance::display() const { return effect::Display{&radiance(), exposure_}; }

effect::Effect entry() {
  const std::vector<std::string> camera{"run.size",      "run.supersample", "camera.position",
                                        "camera.target", "camera.up",       "camera.vertical_fov_deg"};
  const std::vector<std::string> seen = effect::joined(camera, {"seed", "scene.source", "scene.image"});
  const std::vector<std::string> depth =
      effect::joined(seen, {"scene.depth_image", "scene.depth_encoding", "scene.depth_scale", "scene.near", "scene.far"});
  const std::vector<std::string> in_metres{"run.size",          "run.supersample", "scene.depth_image", "scene.depth_encoding",
                                           "scene.depth_scale", "scene.far"};
  return {"edge_splash",
          {"as-published", "corrected"},
          parameters(),
          &effect_info(),
          memory_of,
          open_scene,
          {{"street", {"seed", "scene.source"}},
           {"night_street view", effect::joined(camera, {"seed", "scene.source", "scene.far"})},
           {"edge_splash shapes", effect::joined(camera, {"scene.source", "scene.far"})},
           {"picture", {"scene.image", "scene.depth_image", "scene.layer_image", "scene.noise_image"}},
           {"depth picture", in_metres},
           {"edge_splash clipped depth", effect::joined(camera, {"seed", "scene.source", "scene.near", "scene.far"})},
           {"edge_splash scene", seen},
           {"edge_splash depth", effect::joined(depth, {"scene.reversed_depth"})},
           {"edge_splash layer", effect::joined(seen, {"scene.layer_image"})},
           {"edge_splash noise", {"seed", "scene.noise_image", "edge_splash.splashes"}}}};
}

}  // namespace rainref::edge_splash
