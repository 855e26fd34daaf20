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
