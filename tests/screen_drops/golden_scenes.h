// The scenes of screen_drops behind tests/golden/hashes.txt: every pass, variant and storage, at frames 0, 1, 2 and 59.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "golden/lines.h"
#include "rainref/executor.h"
#include "scene/test_card.h"
#include "screen_drops/flow.h"
#include "screen_drops/host.h"
#include "settings.h"

namespace rainref::screen_drops {

struct GoldenScene {
  std::string name;
  Settings settings;
  std::optional<FlowSettings> flow;
};

inline std::vector<GoldenScene> golden_scenes() {
  std::vector<GoldenScene> scenes;
  for (const Variant variant : {Variant::as_published, Variant::corrected}) {
    const auto add = [&](Rounding rounding, bool other, const std::string& what) {
      Settings s = rainref::test::screen_drops_settings();
      s.variant = variant;
      s.rounding = rounding;
      s.width = 97;
      s.height = 61;
      s.seed = 11;
      s.grid = 0.04;
      s.keep = 0.15;
      s.noise_size = 32;
      s.printed_misprint = other;
      s.pane_height = 0.04;
      s.shortest_cycle = 0.3;
      s.longest_cycle = 2;
      s.camera_position = {2.2, 1.7, 12};
      s.camera_target = {0.6, 1.9, -20};
      std::optional<FlowSettings> flow;
      if (variant == Variant::corrected && other) {
        flow.emplace();
        flow->pane = {s.pane_height * s.width / s.height, s.pane_height};
        flow->wind = 20;
        flow->warm_up = 1;
        flow->substeps = 2;
        flow->drops.capacity = 2000;
        flow->drops.seed = 11;
        flow->drops.rain_rate = 60;
        flow->splat.width = 90;
        flow->splat.height = 70;
        flow->splat.rounding = rounding;
      }
      scenes.push_back({fmt::format("screen_drops/{}/{}", name(variant), what), s, flow});
    };
    const char* other = variant == Variant::corrected ? "flow" : "misprint";
    add(Rounding::rne, false, "still");
    add(Rounding::rtz, false, "still/rtz");
    add(Rounding::rne, true, other);
  }
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
  return golden::lines_of<ScreenDrops>(scene.name, frames, caller, scene.settings, golden_inputs(scene.settings, executor), executor,
                                       scene.flow ? &*scene.flow : nullptr);
}

}  // namespace rainref::screen_drops
