// The scenes of rainy_glass behind tests/golden/hashes.txt: every pass, variant and storage, at frames 0, 1, 2 and 59.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "golden/lines.h"
#include "rainref/executor.h"
#include "rainref/rainy_glass.h"
#include "rainy_glass/host.h"
#include "scene/test_card.h"
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
      scenes.push_back({fmt::format("rainy_glass/{}/{}", name(variant), what), s});
    };
    add(Format::rgba8, Rounding::rne, Shape::pane, false, "rgba8");
    add(Format::rgba16f, Rounding::rne, Shape::pane, false, "rgba16f");
    add(Format::rgba16f, Rounding::rtz, Shape::pane, false, "rgba16f/rtz");
    add(Format::rgba16f, Rounding::rne, Shape::sphere, true, "sphere");
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
  return golden::lines_of<RainyGlass>(scene.name, frames, caller, scene.settings, golden_surroundings(scene.settings, executor), executor);
}

}  // namespace rainref::rainy_glass
