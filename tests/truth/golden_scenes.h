// The traced pictures behind tests/golden/hashes.txt: a natural puddle in the street, a basin under a panorama, drops on a windshield,
// flat and bent, on a window and on a conservatory's pane.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "capture/hashing.h"
#include "truth/puddle_scene.h"
#include "truth/rainy_glass_view.h"
#include "truth/screen_drops_view.h"
#include "truth/windshield_view.h"
#include "scene/test_card.h"
#include "rainy_glass/backdrop.h"
#include "rainy_glass/golden_scenes.h"
#include "screen_drops/golden_scenes.h"
#include "windshield/golden_scenes.h"
#include "settings.h"

namespace rainref::truth {

struct GoldenScene {
  std::string name;
  int frame;  ///< that is traced; the first is 0
  std::function<Picture(const parallel::Executor&, const TracerOptions&)> trace;
};

inline GoldenScene golden_puddle(const std::string& what, const puddle::Settings& s, bool is_street, int samples) {
  static const puddle::Surroundings around = [] {
    puddle::Surroundings made;
    made.environment = scene::TestCard().panorama(64, 32, {0, 0.05, 0}, parallel::Executor());
    return made;
  }();
  return {"compositor/puddle/" + what, 19, [=](const parallel::Executor& executor, const TracerOptions& tracer) {
            puddle::Puddle puddle(s, around, executor);
            for (int frame = 0; frame < 20; ++frame) puddle.simulate();
            PuddleScene traced(s, around, {tracer, is_street ? scene::TestCard::make() : nullptr, samples}, executor);
            traced.update(puddle, executor);
            return trace_picture(traced.scene(), traced.camera(), s.width, s.height, {{}, samples}, executor);
          }};
}

inline GoldenScene golden_windshield(const std::string& what, double radius, int samples) {
  return {"compositor/windshield/" + what, 9, [=](const parallel::Executor& executor, const TracerOptions& tracer) {
            const scene::Config config = windshield::config_of("corrected", R"(seed = 5
[run]
size = [97, 61]
fps = 10
[wipers]
count = 0
[windshield]
height_size = [160, 93]
[rain]
rate = 150
smallest_drop = 1.5
[scene]
size = [64, 36]
[camera]
vertical_fov_deg = 8
)");
            const windshield::Settings settings = windshield::settings_from(config);
            windshield::Windshield windshield(config, {{}, {}, scene::TestCard::make()}, executor);
            for (int frame = 0; frame < 10; ++frame) {
              windshield.simulate();
              windshield.render();
            }
            const WindshieldView view(settings, {5e-3, radius}, tracer, scene::TestCard::make(), executor);
            return trace_picture(*view.scene(windshield), view.camera(), 97, 61, {{}, samples}, executor);
          }};
}

/// The room's own golden scene, corrected, with flowing water.
inline GoldenScene golden_window() {
  return {"compositor/screen_drops/flow", 2, [](const parallel::Executor& executor, const TracerOptions& tracer) {
            const auto scene = golden::named(screen_drops::golden_scenes(), "screen_drops/corrected/flow");
            const screen_drops::Settings s = scene.settings();
            const screen_drops::FlowSettings flow = scene.flow().value();
            const screen_drops::Inputs in = screen_drops::golden_inputs(s, executor);
            screen_drops::ScreenDrops drops(s, in, executor, &flow);
            for (int frame = 0; frame < 3; ++frame) drops.next_frame();
            const ScreenDropsView view(s, in.colour, 4e-3, tracer, executor);
            return trace_picture(*view.scene(drops), view.camera(), s.width, s.height, {{}, 4}, executor);
          }};
}

/// The same, turned about the vertical.
inline GoldenScene golden_glass() {
  return {"compositor/rainy_glass/pane", 2, [](const parallel::Executor& executor, const TracerOptions& tracer) {
            rainy_glass::Settings s = golden::named(rainy_glass::golden_scenes(), "rainy_glass/corrected/rgba16f").settings();
            s.yaw_deg = 20;
            const auto card = scene::TestCard::make();
            const rainy_glass::Surroundings around = rainy_glass::make_backdrop(s, {0.02, 0.3, 0.03}, *card, executor);
            rainy_glass::RainyGlass glass(s, around, executor);
            for (int frame = 0; frame < 3; ++frame) glass.next_frame();
            const RainyGlassView view(
                s, around, RainyGlassView::Street{card, rainy_glass::make_backdrop(s, {0.02, 0, 0.03}, *card, executor)}, 4e-3, tracer);
            return trace_picture(*view.scene(glass), view.camera(), s.width, s.height, {{}, 4}, executor);
          }};
}

inline std::vector<GoldenScene> golden_scenes() {
  puddle::Settings s = rainref::test::puddle_settings();
  s.width = 97;
  s.height = 61;
  s.seed = 11;
  s.grid = {89, 57};
  s.cell_size = 0.02;
  s.rain_rate = 40;
  s.damping = 0.97;
  s.fog_depth = 0.02;
  s.water_turbidity = 6;
  s.tint = {0.05, 0.045, 0.04};
  s.camera_position = {0.2, 0.4, 1.2};
  s.camera_target = {0, 0, 0.1};
  puddle::Settings basin = s;
  basin.shape = puddle::Shape::basin;
  basin.use_checkerboard = true;
  basin.ground_scale = 7;
  basin.env_rotation = 0.5;
  return {golden_puddle("street", s, true, 1),
          golden_puddle("panorama", basin, false, 4),
          golden_windshield("flat", 0, 4),
          golden_windshield("bent", 3, 1),
          golden_window(),
          golden_glass()};
}

/// "scene frame pass buffer hash" of the picture.
inline std::vector<std::string> golden_lines(const GoldenScene& scene, const parallel::Executor& executor,
                                             const TracerOptions& tracer = {}) {
  const Picture p = scene.trace(executor, tracer);
  std::vector<std::string> lines;
  const auto line = [&](const char* buffer, const Image& image) {
    lines.push_back(fmt::format("{} {} compositor {} {}", scene.name, scene.frame, buffer, capture::hash_of(image).text()));
  };
  line("beauty", p.beauty);
  line("normal", p.normal);
  line("depth", p.depth);
  line("film", p.film);
  line("mask", p.mask);
  return lines;
}
inline std::vector<std::string> golden_lines(const GoldenScene& scene, const parallel::Executor& executor, int /*frames*/,
                                             const golden::Caller& /*caller*/) {
  return golden_lines(scene, executor);
}

}  // namespace rainref::truth
