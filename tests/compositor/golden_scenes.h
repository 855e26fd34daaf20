// The traced pictures behind tests/golden/hashes.txt: a natural puddle in the street, a basin under a panorama.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "capture/hashing.h"
#include "compositor/puddle_scene.h"
#include "night_street/night_street.h"

namespace rainref::compositor {

struct GoldenScene {
  std::string name;
  puddle::Settings settings;
  bool is_street;
  int samples;
};

inline std::vector<GoldenScene> golden_scenes() {
  puddle::Settings s;
  s.width = 97;
  s.height = 61;
  s.seed = 11;
  s.grid = {89, 57};
  s.cell_size = 0.02;
  s.rain_rate = 40;
  s.damping = 0.97;
  s.fog_depth = 0.02;
  s.water_turbidity = 6;
  s.tint = {0.05, 0.045, 0.04};
  s.camera_position = {0.2, 0.4, 1.2};
  s.camera_target = {0, 0, 0.1};
  puddle::Settings basin = s;
  basin.shape = puddle::Shape::basin;
  basin.use_checkerboard = true;
  basin.ground_scale = 7;
  basin.env_rotation = 0.5;
  return {{"compositor/puddle/street", s, true, 1}, {"compositor/puddle/panorama", basin, false, 4}};
}

/// "scene frame pass buffer hash" of the picture after the 20th frame.
inline std::vector<std::string> golden_lines(const GoldenScene& scene, const parallel::Executor& executor, const TracerOptions& tracer = {}) {
  static const puddle::Surroundings around = [] {
    puddle::Surroundings made;
    made.environment = night_street::Street().panorama(64, 32, {0, 0.05, 0}, parallel::Executor());
    return made;
  }();
  puddle::Puddle puddle(scene.settings, around, executor);
  for (int frame = 0; frame < 20; ++frame) puddle.simulate();
  PuddleScene traced(scene.settings, around, {tracer, scene.is_street, scene.samples}, executor);
  traced.update(puddle, executor);
  const Picture p = trace_picture(traced.scene(), traced.camera(), scene.settings.width, scene.settings.height, {{}, scene.samples}, executor);
  std::vector<std::string> lines;
  const auto line = [&](const char* buffer, const Image& image) {
    lines.push_back(fmt::format("{} 19 compositor {} {}", scene.name, buffer, capture::hash_of(image).text()));
  };
  line("beauty", p.beauty);
  line("normal", p.normal);
  line("depth", p.depth);
  line("film", p.film);
  line("mask", p.mask);
  return lines;
}

}  // namespace rainref::compositor
