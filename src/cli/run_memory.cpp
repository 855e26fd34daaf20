#include "cli/run_memory.h"

#include <fmt/format.h>

#include "compositor/parameters.h"
#include "edge_splash/memory.h"
#include "edge_splash/parameters.h"
#include "night_street/memory.h"
#include "puddle/memory.h"
#include "puddle/parameters.h"
#include "rainy_glass/backdrop.h"
#include "rainy_glass/memory.h"
#include "rainy_glass/parameters.h"
#include "screen_drops/memory.h"
#include "screen_drops/flow.h"
#include "screen_drops/parameters.h"
#include "windshield/memory.h"
#include "windshield/scene_keys.h"

namespace rainref::cli {
namespace {

std::size_t image(Format format, int width, int height) { return Image::memory_bytes(format, width, height); }

RunMemory run_of(std::string subject, int width, int height, std::size_t exr_images, std::size_t exr_texel) {
  return {std::move(subject), {}, static_cast<std::size_t>(width) * static_cast<std::size_t>(height), exr_images, exr_texel};
}
/// A traced picture, its channels and its display, if the scene wants one.
void hold_traced(RunMemory& m, const scene::Config& config, int width, int height) {
  if (!compositor::choice_from(config).is_traced) return;
  m.peak.hold(2 * image(Format::rgba16f, width, height) + image(Format::r32f, width, height) + 2 * image(Format::r16f, width, height) +
              image(Format::rgba8, width, height));
  m.exr_images = 8 + 8 + 4 + 2 + 2;
  m.exr_texel = 6 + 6 + 4 + 2 + 2;
}
bool is_named(const scene::Config& config, const char* key) { return !config.text(key).empty(); }

}  // namespace

void add_pictures(RunMemory& m, bool png, bool exr) {
  if (png) m.peak.pass(m.pixels * (4 + 3 + 4));
  if (exr) m.peak.pass(m.pixels * (m.exr_images + m.exr_texel + m.exr_texel * 3 / 2));
}

void add_captures(RunMemory& m) { m.peak.pass(m.peak.held()); }

RunMemory puddle_memory(const scene::Config& config) {
  const puddle::Settings s = puddle::settings_from(config);
  const bool corrected = s.variant == Variant::corrected;
  const std::array<int, 2> grid = corrected ? s.grid : std::array{s.width, s.height};
  RunMemory m = run_of(fmt::format("run.size {}x{} with a wave of {}x{}", s.width, s.height, grid[0], grid[1]), s.width, s.height,
                       8 + 8 + 16, 6 + 6 + 12);
  puddle::PictureSizes sizes;
  if (is_named(config, "environment.image"))
    sizes.environment = {1, 1};
  else
    m.peak.then(night_street::panorama_memory(sizes.environment[0], sizes.environment[1]));
  if (is_named(config, "puddle.ground_image")) sizes.ground = {1, 1};
  m.peak.then(puddle::memory(s, sizes));
  hold_traced(m, config, s.width, s.height);
  return m;
}

RunMemory edge_splash_memory(const scene::Config& config) {
  const edge_splash::Settings s = edge_splash::settings_from(config);
  RunMemory m = run_of(fmt::format("run.size {}x{}", s.width, s.height), s.width, s.height, 8 + 4, 8 + 4);
  const std::string source = config.text("scene.source");
  const std::size_t inputs = image(Format::rgba32f, s.width, s.height) + image(Format::r32f, s.width, s.height);
  if (source == "street") {
    m.peak.then(night_street::view_memory(s.width, s.height));
    m.peak.release(night_street::normal_bytes(s.width, s.height));
  } else {
    m.peak.hold(inputs);
  }
  m.peak.then(edge_splash::memory(s));
  m.peak.release(inputs);
  return m;
}

RunMemory screen_drops_memory(const scene::Config& config) {
  const screen_drops::Settings s = screen_drops::settings_from(config);
  RunMemory m = run_of(fmt::format("run.size {}x{}", s.width, s.height), s.width, s.height, 8 + 8, 6 + 6);
  if (is_named(config, "scene.image") || is_named(config, "scene.panorama")) {
    m.peak.hold(image(Format::rgba32f, s.width, s.height));
  } else {
    m.peak.then(night_street::view_memory(s.width, s.height));
    m.peak.release(night_street::normal_bytes(s.width, s.height) + image(Format::r32f, s.width, s.height));
  }
  const std::optional<screen_drops::FlowSettings> flow = screen_drops::flow_from(config, s);
  m.peak.then(screen_drops::memory(s, flow ? &*flow : nullptr,
                                   flow ? flow->warm_up + static_cast<double>(config.integer("run.frames")) / s.fps : 0));
  hold_traced(m, config, s.width, s.height);
  return m;
}

RunMemory rainy_glass_memory(const scene::Config& config) {
  const rainy_glass::Settings s = rainy_glass::settings_from(config);
  RunMemory m =
      run_of(fmt::format("run.size {}x{} with maps.size {}", s.width, s.height, s.map_size), s.width, s.height, 8 + 8 + 16, 6 + 6 + 12);
  const std::size_t colour = image(Format::rgba32f, s.width, s.height), depth = image(Format::r32f, s.width, s.height);
  if (is_named(config, "scene.image") || is_named(config, "scene.panorama")) {
    m.peak.hold(colour + depth);
  } else {
    m.peak.then(night_street::view_memory(s.width, s.height));
    if (s.use_probe) m.peak.then(night_street::panorama_memory(1024, 512));
    m.peak.release(night_street::normal_bytes(s.width, s.height));
  }
  m.peak.pass(colour);                                              // out of focus
  m.peak.pass(colour + image(Format::rgba16f, s.width, s.height));  // the glass, for its bars
  m.peak.then(rainy_glass::memory(s));
  if (compositor::choice_from(config).is_traced) m.peak.hold(colour + depth);  // the scene without bars
  hold_traced(m, config, s.width, s.height);
  return m;
}

RunMemory windshield_memory(const scene::Config& config) {
  const windshield::Settings s = windshield::settings_from(config);
  RunMemory m = run_of(fmt::format("run.size {}x{} with scene.size {}x{} and windshield.height_size {}x{} for {} drops", s.picture.width,
                                   s.picture.height, s.scene_size[0], s.scene_size[1], s.surface.width, s.surface.height, s.drops.capacity),
                       s.picture.width, s.picture.height, 8, 6);
  m.peak = windshield::memory(s, static_cast<int>(config.integer("run.frames")),
                              is_named(config, "scene.image") ? s.scene_size : std::array{0, 0});
  hold_traced(m, config, s.picture.width, s.picture.height);
  return m;
}

void require_memory(const RunMemory& memory) { rainref::require_memory(memory.subject, memory.peak.peak()); }

}  // namespace rainref::cli
