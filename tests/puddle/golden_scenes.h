// The scenes behind tests/golden/hashes.txt: every pass, variant and storage, at frames 0, 1, 2 and 59.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "config_of.h"
#include "golden/lines.h"
#include "puddle/parameters.h"
#include "rainref/executor.h"
#include "rainref/puddle.h"
#include "scene/test_card.h"

namespace rainref::puddle {

constexpr const char* published_puddle = R"(seed = 11
run.size = [97, 61]
puddle.drop_count = 10
puddle.drop_intensity = 1
puddle.rain_speed = 3
)";
constexpr const char* corrected_puddle = R"(seed = 11
run.size = [97, 61]
puddle.grid = [89, 57]
puddle.cell_size = 0.02
puddle.damping = 0.97
puddle.shore_width = 0.002
puddle.puddle_depth = 0.05
puddle.ground_scale = 1
puddle.water_turbidity = 1
puddle.fog_depth = 0.02
puddle.vignette = 0.2
puddle.tint = [0.05, 0.045, 0.04]
rain.rate = 20
rain.smallest_drop = 0.5
display.exposure = 0
camera.position = [0.2, 0.5, 1.6]
camera.target = [0, 0, 0]
camera.vertical_fov_deg = 45
)";

struct GoldenScene {
  std::string name, variant, toml;
  Settings settings() const { return settings_from(rainref::test::config_of("puddle", parameters(), variant, toml)); }
};

inline std::vector<GoldenScene> golden_scenes() {
  std::vector<GoldenScene> scenes;
  const auto add = [&](const std::string& variant, const char* what, const std::string& more) {
    scenes.push_back(
        {fmt::format("puddle/{}/{}", variant, what), variant, (variant == "corrected" ? corrected_puddle : published_puddle) + more});
  };
  for (const char* variant : {"as-published", "corrected"}) {
    add(variant, "rg16f", "");
    add(variant, "rg16f/rtz", "puddle.rounding = 'rtz'\n");
    add(variant, "rg32f", "puddle.storage = 'rg32f'\n");
    add(variant, "rgba8", "puddle.storage = 'rgba8'\n");
  }
  add("as-published", "rg16f/step_2", "puddle.step = 2\n");
  add("corrected", "rg16f/rim", "puddle.rim_width = 0.2\n");  // ten cells
  add("corrected", "rg16f/objects",
      "puddle.objects = '0.08 0.01: 0 -0.3 0, 0.5 0.2 0.1, 1 0.3 -0.2; 0.1 -0.003: 0.01 0.3 -0.3, 0.9 -0.2 -0.25'\n"
      "rain.shelter = '-0.2 -0.1 0.105 0.3'\n");
  return scenes;
}

/// What is around the puddle in all of them.
inline Surroundings golden_surroundings(const parallel::Executor& executor) {
  Surroundings around;
  around.environment = scene::TestCard().panorama(64, 32, {0, 0.05, 0}, executor);
  return around;
}

/// golden/lines.h.
inline std::vector<std::string> golden_lines(const GoldenScene& scene, const parallel::Executor& executor, int frames = 60,
                                             const golden::Caller& caller = golden::call_plainly) {
  return golden::lines_of<Puddle>(scene.name, frames, caller, scene.settings(), golden_surroundings(executor), executor);
}

}  // namespace rainref::puddle
