// The scenes behind tests/golden/hashes.txt: every pass, variant and storage, at frames 0, 1, 2 and 59.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "golden/lines.h"
#include "rainref/executor.h"
#include "rainref/puddle.h"
#include "scene/test_card.h"
#include "settings.h"

namespace rainref::puddle {

struct GoldenScene {
  std::string name;
  Settings settings;
};

inline std::vector<GoldenScene> golden_scenes() {
  std::vector<GoldenScene> scenes;
  for (const Variant variant : {Variant::as_published, Variant::corrected}) {
    for (const Format storage : {Format::rg16f, Format::rg32f, Format::rgba8}) {
      for (const Rounding rounding : {Rounding::rne, Rounding::rtz}) {
        if (rounding == Rounding::rtz && storage != Format::rg16f) continue;
        Settings s = rainref::test::puddle_settings();
        s.variant = variant;
        s.storage = storage;
        s.rounding = rounding;
        s.width = 97;
        s.height = 61;
        s.seed = 11;
        if (variant == Variant::as_published) {
          s.drop_count = 10;
          s.rain_speed = 3;
          s.damping = 0.98;
          s.reflectivity = 0.6;
          s.vignette = 0.4;
          s.fog_depth = 0.01;
          s.use_checkerboard = true;
          s.ground_scale = 0.15;
          s.water_turbidity = 0.05;
          s.puddle_depth = 5;
          s.tint = {0.02, 0.05, 0.06};
          s.camera_position = {20, 18, 14};
          s.camera_target = {-6, -4, 10};
          s.vertical_fov_deg = 60;
        } else {
          s.grid = {89, 57};
          s.cell_size = 0.02;
          s.ground_reach = 0.3;
          s.rain_rate = 20;
          s.damping = 0.97;
          s.fog_depth = 0.02;
          s.vignette = 0.2;
          s.tint = {0.05, 0.045, 0.04};
          s.camera_position = {0.2, 0.5, 1.6};
          s.camera_target = {0, 0, 0};
        }
        scenes.push_back({fmt::format("puddle/{}/{}{}", name(variant), info(storage).name, rounding == Rounding::rtz ? "/rtz" : ""), s});
      }
    }
  }
  GoldenScene& rim = scenes.emplace_back(
      *std::find_if(scenes.begin(), scenes.end(), [](const GoldenScene& s) { return s.name == "puddle/corrected/rg16f"; }));
  rim.name += "/rim";
  rim.settings.rim_width = 0.2;  // ten cells
  GoldenScene& moved = scenes.emplace_back(
      *std::find_if(scenes.begin(), scenes.end(), [](const GoldenScene& s) { return s.name == "puddle/corrected/rg16f"; }));
  moved.name += "/objects";
  moved.settings.objects = "0.08 0.01: 0 -0.3 0, 0.5 0.2 0.1, 1 0.3 -0.2; 0.1 -0.003: 0.01 0.3 -0.3, 0.9 -0.2 -0.25";
  moved.settings.shelter = "-0.2 -0.1 0.105 0.3";
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
  return golden::lines_of<Puddle>(scene.name, frames, caller, scene.settings, golden_surroundings(executor), executor);
}

}  // namespace rainref::puddle
