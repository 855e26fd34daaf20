// The scenes of screen_drops behind tests/golden/hashes.txt: every pass, variant and storage, at frames 0, 1, 2 and 59.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "config_of.h"
#include "golden/lines.h"
#include "rainref/executor.h"
#include "scene/test_card.h"
#include "screen_drops/flow.h"
#include "screen_drops/host.h"
#include "screen_drops/parameters.h"

namespace rainref::screen_drops {

inline scene::Config config_of(const std::string& variant, const std::string& toml) {
  return rainref::test::config_of("screen_drops", parameters(), variant, toml);
}

constexpr const char* window_scene = R"(seed = 11
run.size = [97, 61]
display.exposure = 0
camera.position = [2.2, 1.7, 12]
camera.target = [0.6, 1.9, -20]
camera.vertical_fov_deg = 40
)";
constexpr const char* published_drops = R"(drops.grid = 0.04
drops.keep = 0.15
noise.size = 32
)";
constexpr const char* corrected_drops = R"(glass.height = 0.04
drops.shortest_cycle = 0.3
drops.longest_cycle = 2
)";
constexpr const char* golden_flow = R"(flow.warm_up = 1
flow.substeps = 2
flow.capacity = 2000
flow.height_size = [90, 70]
rain.wind = 20
rain.rate = 60
)";

struct GoldenScene {
  std::string name, variant, toml;
  Settings settings() const { return settings_from(config_of(variant, toml)); }
  std::optional<FlowSettings> flow() const { return flow_from(config_of(variant, toml), settings()); }
};

inline std::vector<GoldenScene> golden_scenes() {
  std::vector<GoldenScene> scenes;
  const auto add = [&](const std::string& variant, const char* what, const std::string& more) {
    scenes.push_back({fmt::format("screen_drops/{}/{}", variant, what), variant,
                      std::string(window_scene) + (variant == "corrected" ? corrected_drops : published_drops) + more});
  };
  const std::string truncated = "drops.rounding = 'rtz'\n", still = "flow.on = false\n";
  add("as-published", "still", "");
  add("as-published", "still/rtz", truncated);
  add("as-published", "misprint", "drops.printed_misprint = true\n");
  add("as-published", "gradient", "drops.lod = 'gradient'\nscene.wrap = 'repeat'\nbackground.level = 2\n");
  add("as-published", "fixed", "drops.lod = 'fixed'\ndrops.level = 1.5\nscene.wrap = 'mirror'\nbackground.level = 3.5\n");
  add("corrected", "still", still);
  add("corrected", "still/rtz", still + truncated);
  add("corrected", "flow", golden_flow);
  return scenes;
}

/// What is seen through the window.
inline Inputs golden_inputs(const Settings& s, const parallel::Executor& executor) {
  Inputs in;
  in.colour = scene::TestCard().view(scene_camera(s), s.width, s.height, 1000, executor).colour;
  return in;
}

/// golden/lines.h.
inline std::vector<std::string> golden_lines(const GoldenScene& scene, const parallel::Executor& executor, int frames = 60,
                                             const golden::Caller& caller = golden::call_plainly) {
  const Settings s = scene.settings();
  const std::optional<FlowSettings> flow = scene.flow();
  return golden::lines_of<ScreenDrops>(scene.name, frames, caller, s, golden_inputs(s, executor), executor, flow ? &*flow : nullptr);
}

}  // namespace rainref::screen_drops
