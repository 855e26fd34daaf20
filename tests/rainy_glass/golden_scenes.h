// The scenes of rainy_glass behind tests/golden/hashes.txt: every pass, variant and storage, at frames 0, 1, 2 and 59.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "config_of.h"
#include "golden/lines.h"
#include "rainref/executor.h"
#include "rainref/rainy_glass.h"
#include "rainy_glass/host.h"
#include "rainy_glass/parameters.h"
#include "scene/test_card.h"

namespace rainref::rainy_glass {

inline scene::Config config_of(const std::string& variant, const std::string& toml) {
  return rainref::test::config_of("rainy_glass", parameters(), variant, toml);
}

constexpr const char* small_maps = R"(seed = 11
run.size = [97, 61]
glass.drop_tile = 0.25
glass.rivulet_tile = 0.25
maps.size = 90
maps.droplets = 90
maps.largest_droplet = 0.06
maps.smallest_droplet = 0.01
maps.contact_angle = 40
maps.trails = 8
maps.trail_half_width = 0.02
display.exposure = 0
camera.position = [2.2, 1.7, 12]
camera.target = [0.6, 1.9, -20]
)";
/// Every reading of the shipped shader, on a ball.
constexpr const char* shipped = R"(glass.shape = 'sphere'
glass.distortion = 0.01
glass.tint = [0.88, 0.92, 0.92]
glass.map_turn = 15
glass.rivulet_turn = -25
maps.remap = 'before'
rain.time_offset = 'signed'
rain.drop_period = 3.3333333333333335
rain.flow_period = 4.3478260869565215
rain.flow_weight = 'squared'
rain.flow_across = [-0.1, 0.1]
rain.flow_along = [0, 3]
rain.rivulet_speed = 0.05
rain.rivulet_amount = 2
rain.fade_from = 0.85
)";
constexpr const char* corrected_rain = R"(rain.amount = 0.8
rain.drop_period = 6
rain.flow_strength = 0.02
)";

struct GoldenScene {
  std::string name, variant, toml;
  Settings settings() const { return settings_from(config_of(variant, toml)); }
};

inline std::vector<GoldenScene> golden_scenes() {
  std::vector<GoldenScene> scenes;
  for (const std::string variant : {"as-published", "corrected"}) {
    const auto add = [&](const char* what, const std::string& more) {
      scenes.push_back(
          {fmt::format("rainy_glass/{}/{}", variant, what), variant, small_maps + (variant == "corrected" ? corrected_rain + more : more)});
    };
    const std::string halves = "maps.storage = 'rgba16f'\n";
    add("rgba8", "maps.storage = 'rgba8'\n");
    add("rgba16f", halves);
    add("rgba16f/rtz", halves + "maps.rounding = 'rtz'\n");
    add("sphere", halves + "glass.shape = 'sphere'\nglass.background = 'probe'\n");
    if (variant == "as-published") add("shipped", shipped);
  }
  return scenes;
}

/// What is seen through the glass, and all around it.
inline Surroundings golden_surroundings(const Settings& s, const parallel::Executor& executor) {
  const scene::TestCard card;
  scene::Scenery::View view = card.view(camera(s), s.width, s.height, 1000, executor);
  Surroundings around;
  around.colour = std::move(view.colour);
  around.depth = std::move(view.depth);
  if (s.use_probe) around.probe = card.panorama(64, 32, camera(s).position, executor);
  return around;
}

/// golden/lines.h.
inline std::vector<std::string> golden_lines(const GoldenScene& scene, const parallel::Executor& executor, int frames = 60,
                                             const golden::Caller& caller = golden::call_plainly) {
  const Settings s = scene.settings();
  return golden::lines_of<RainyGlass>(scene.name, frames, caller, s, golden_surroundings(s, executor), executor);
}

}  // namespace rainref::rainy_glass
