// The scenes of edge_splash behind tests/golden/hashes.txt: both passes of both variants, both targets, both roundings, at frames
// 0, 1, 2 and 59.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "edge_splash/host.h"
#include "edge_splash/shapes.h"
#include "golden/lines.h"
#include "rainref/edge_splash.h"
#include "rainref/executor.h"
#include "settings.h"

namespace rainref::edge_splash {

struct GoldenScene {
  std::string name;
  Settings settings;
};

inline std::vector<GoldenScene> golden_scenes() {
  std::vector<GoldenScene> scenes;
  for (const Variant variant : {Variant::as_published, Variant::corrected}) {
    for (const Rounding rounding : {Rounding::rne, Rounding::rtz}) {
      Settings s = rainref::test::edge_splash_settings();
      s.variant = variant;
      s.rounding = rounding;
      s.width = 97;
      s.height = 61;
      s.seed = 11;
      s.drop_color = {0.5, 0.6, 0.7};
      s.drop_alpha = 0.8;
      s.rain_drop_scale = 0.45;
      s.band = 0.06;
      s.largest_band = 0.05;
      s.exposure = 1.2;
      s.camera_position = {-0.9, 1.05, -0.4};
      s.camera_target = {-1.4, 0.6, -3};
      s.vertical_fov_deg = 60;
      const auto add = [&](const char* target) {
        scenes.push_back({fmt::format("edge_splash/{}{}{}", name(variant), target, rounding == Rounding::rtz ? "/rtz" : ""), s});
      };
      add("");
      if (variant == Variant::corrected) continue;
      s.storage = Format::rgba8;
      add("/rgba8");
    }
  }
  return scenes;
}

/// golden/lines.h.
inline std::vector<std::string> golden_lines(const GoldenScene& scene, const parallel::Executor& executor, int frames = 60,
                                             const golden::Caller& caller = golden::call_plainly) {
  const Settings& s = scene.settings;
  ShapesView view = render_shapes(camera(s), s.width, s.height, s.depth.far_plane, executor);
  Inputs in;
  in.colour = std::move(view.colour);
  in.depth = std::move(view.depth);
  in.depth_is_distance = true;
  return golden::lines_of<EdgeSplash>(scene.name, frames, caller, s, in, executor);
}

}  // namespace rainref::edge_splash
