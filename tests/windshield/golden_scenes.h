// The scenes behind tests/golden/hashes.txt: every pass, variant and rounding, at frames 0, 1, 2 and 59.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "config_of.h"
#include "golden/lines.h"
#include "rainref/executor.h"
#include "rainref/windshield.h"
#include "windshield/parameters.h"

namespace rainref::windshield {

/// A scene of this effect from its text, the lines `effect` and `variant` aside.
inline scene::Config config_of(const std::string& variant, const std::string& toml) {
  return rainref::test::config_of("windshield", parameters(), variant, toml);
}

/// A scene before the car with structure and no street behind it.
inline Surroundings small_surroundings(int width = 37, int height = 23) {
  Surroundings s{Image(Format::rgba16f, width, height), Image(Format::r32f, width, height)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 4; ++c)
        s.colour.row<Half>(y)[4 * x + c] =
            Half{static_cast<std::uint16_t>(c == 3 ? 0x3c00 : 0x3000 + 64 * ((7 * x + 13 * y + 5 * c) % 17))};
      s.depth.row<float>(y)[x] = static_cast<float>(5 + (3 * x + y) % 11);
    }
  }
  return s;
}

constexpr const char* wet_drive = R"(seed = 5
[run]
size = [97, 61]
fps = 60
[vehicle]
key_frames = "0 2 0; 1 9 0.3; 2 4 -0.1"
[wipers]
cycles_per_minute = 60
[windshield]
height_size = [89, 53]
)";

struct GoldenScene {
  std::string name, variant, toml;
};
inline std::vector<GoldenScene> golden_scenes() {
  std::vector<GoldenScene> scenes;
  for (const std::string variant : {"as-published", "corrected"}) {
    for (const std::string rounding : {"rne", "rtz"}) {
      const std::string more = "rounding = '" + rounding + "'\n" +
                               (variant == "corrected" ? "[rain]\nrate = 120\nsmallest_drop = 0.8\n" : "spawn_rate = 3000\n");
      scenes.push_back({fmt::format("windshield/{}{}", variant, rounding == "rtz" ? "/rtz" : ""), variant, wet_drive + more});
    }
  }
  scenes.push_back(
      {"windshield/corrected/substeps", "corrected", std::string(wet_drive) + "substeps = 3\nblend = 'max'\n[rain]\nrate = 120\n"});
  scenes.push_back({"windshield/as-published/float", "as-published",
                    std::string(wet_drive) + "accumulate = 'float'\nkernel = 'quartic'\nblend = 'max'\n"});
  scenes.push_back({"windshield/as-published/trails", "as-published", std::string(wet_drive) + "height_tau = 0.5\nblend = 'max'\n"});
  scenes.push_back({"windshield/corrected/behind", "corrected",
                    std::string(wet_drive) + "[rain]\nrate = 120\n[falling_rain]\non = true\nexposure = 0.02\ngain = 10\n"});
  scenes.push_back({"windshield/corrected/condensation", "corrected",
                    std::string(wet_drive) + "[rain]\nrate = 120\n[condensation]\non = true\ntau = 2\n"});
  scenes.push_back({"windshield/corrected/smear", "corrected",
                    std::string(wet_drive) + "[rain]\nrate = 120\nsmallest_drop = 0.8\n[smear]\non = true\nwear = 0.6\n"});
  scenes.push_back(
      {"windshield/corrected/lean", "corrected", std::string(wet_drive) + "lean = 0.8\n[rain]\nrate = 120\nsmallest_drop = 0.8\n"});
  // Drops that have merged, and others that merge with them.
  scenes.push_back({"windshield/corrected/neck", "corrected",
                    std::string(wet_drive) + "neck_time = 1.5\nlean = 0.8\n[rain]\nrate = 150\nsmallest_drop = 0.8\n"});
  scenes.push_back({"windshield/corrected/interior", "corrected",
                    std::string(wet_drive) + "[rain]\nrate = 120\n[interior]\non = true\nlight = 0.1\n[camera]\nvertical_fov_deg = 44\n"});
  // Three panes and a weather that changes.
  scenes.push_back(
      {"windshield/corrected/panes", "corrected",
       std::string(wet_drive) +
           "panes = '0.2 0.8 0.9, 1.2 0.8 0.9, 0.2 0.7 1.5; -1 -0.6 1, -1 0.6 1, -0.6 -0.6 1.4'\n[rain]\nkey_frames = '0 20; 1 120'\n"
           "[world]\nwind_key_frames = '0 0 0 0; 1 3 -6 0'\n"});
  // Two roofs, one of them before the car at first; the panes come under them one after another.
  for (const std::string variant : {"as-published", "corrected"})
    scenes.push_back({fmt::format("windshield/{}/shelter", variant), variant,
                      std::string(wet_drive) + "panes = '0.2 0.8 0.9, 1.2 0.8 0.9, 0.2 0.7 1.5'\n" +
                          (variant == "corrected" ? "[falling_rain]\non = true\nexposure = 0.02\ngain = 10\n[rain]\nrate = 120\n"
                                                  : "spawn_rate = 3000\n[rain]\n") +
                          "shelter = '1.58 1.63; 4 5.1'\n"});
  // A wiper on a side window.
  for (const std::string variant : {"as-published", "corrected"})
    scenes.push_back({fmt::format("windshield/{}/pane_wiper", variant), variant,
                      std::string(wet_drive) + "panes = '0.2 0.8 0.9, 1.2 0.8 0.9, 0.2 0.7 1.5'\n" +
                          (variant == "corrected" ? "[rain]\nrate = 120\nsmallest_drop = 0.8\n" : "spawn_rate = 3000\n") +
                          "[pane_1_wipers]\ncount = 2\narrangement = 'opposed'\nkey_frames = '0.01 intermittent 0.5; 0.8 fast'\n"
                          "cycles_per_minute = 150\n"});
  return scenes;
}

/// golden/lines.h.
inline std::vector<std::string> golden_lines(const GoldenScene& scene, const parallel::Executor& executor, int frames = 60,
                                             const golden::Caller& caller = golden::call_plainly) {
  // Not in the caller's state: a program cannot call this, but through Simulation, which pins the state.
  const scene::Config config = config_of(scene.variant, scene.toml);
  return golden::lines_of<Windshield>(scene.name, frames, caller, config, small_surroundings(), executor);
}

}  // namespace rainref::windshield
