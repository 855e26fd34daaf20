// The scenes of rainy_glass behind tests/golden/hashes.txt: every pass, variant and storage, at frames 0, 1, 2 and 59.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "capture/hashing.h"
#include "golden/caller.h"
#include "rainref/executor.h"
#include "rainref/rainy_glass.h"
#include "rainy_glass/backdrop.h"
#include "settings.h"

namespace rainref::rainy_glass {

struct GoldenScene {
  std::string name;
  Settings settings;
};

inline std::vector<GoldenScene> golden_scenes() {
  std::vector<GoldenScene> scenes;
  for (const Variant variant : {Variant::as_published, Variant::corrected}) {
    const auto add = [&](Format storage, Rounding rounding, Shape shape, bool use_probe, const std::string& what) {
      Settings s = rainref::test::rainy_glass_settings();
      s.variant = variant;
      s.map_storage = storage;
      s.rounding = rounding;
      s.shape = shape;
      s.use_probe = use_probe;
      s.width = 97;
      s.height = 61;
      s.seed = 11;
      s.map_size = 90;
      s.droplet_count = 90;
      s.largest_droplet = 0.06;
      s.smallest_droplet = 0.01;
      s.trail_count = 8;
      s.trail_half_width = 0.02;
      s.drop_tile = s.rivulet_tile = 0.25;
      s.camera_position = {2.2, 1.7, 12};
      s.camera_target = {0.6, 1.9, -20};
      if (variant == Variant::as_published) {
        s.rain_amount = 1;
        s.drop_period = s.flow_period = 1;
        s.flow_strength = 1;
        s.flow_cells = 1;
        s.flow_gain = 0.6;
      }
      scenes.push_back({fmt::format("rainy_glass/{}/{}", variant == Variant::as_published ? "as-published" : "corrected", what), s});
    };
    add(Format::rgba8, Rounding::rne, Shape::pane, false, "rgba8");
    add(Format::rgba16f, Rounding::rne, Shape::pane, false, "rgba16f");
    add(Format::rgba16f, Rounding::rtz, Shape::pane, false, "rgba16f/rtz");
    add(Format::rgba16f, Rounding::rne, Shape::sphere, true, "sphere");
  }
  return scenes;
}

/// "scene frame pass buffer hash" for frames 0, 1, 2 and 59, as far as there are so many.
inline std::vector<std::string> golden_lines(const GoldenScene& scene, const parallel::Executor& executor, int frames = 60,
                                             const golden::Caller& caller = golden::call_plainly) {
  static std::map<std::string, Surroundings> made;  // once, however often a test takes the scene
  Surroundings& around = made[scene.name];
  if (around.colour.empty()) around = make_backdrop(scene.settings, {0.02, 0.3, 0.03}, executor);
  std::optional<RainyGlass> glass;
  caller([&] { glass.emplace(scene.settings, around, executor); });
  std::vector<std::string> lines;
  for (int frame = 0; frame < frames; ++frame) {
    capture::HashRecorder recorder;
    const bool golden = frame <= 2 || frame == 59;
    caller([&] { glass->next_frame(golden ? &recorder : nullptr); });
    if (!golden) continue;
    for (const capture::HashLine& line : recorder.take_lines()) lines.push_back(fmt::format("{} {}", scene.name, line.text()));
  }
  return lines;
}

}  // namespace rainref::rainy_glass
