// The pictures of the street behind tests/golden/hashes.txt: no effect's lines say anything of them.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "capture/hashing.h"
#include "golden/lines.h"
#include "night_street/night_street.h"

namespace rainref::night_street {

struct GoldenScene {
  std::string name;
  Options options;
};
inline std::vector<GoldenScene> golden_scenes() { return {{"night_street/standing", {1, false}}, {"night_street/clear_lane", {5, true}}}; }

/// "scene frame pass buffer hash" of a driver's view, of the panorama over a puddle, and of single rays.
inline std::vector<std::string> golden_lines(const GoldenScene& scene, const parallel::Executor& executor, int /*frames*/ = 60,
                                             const golden::Caller& /*caller*/ = golden::call_plainly) {
  const Street street(scene.options);
  const scene::Camera driver{{1.4, 1.3, 60}, {1.2, 1.5, 0}, {0, 1, 0}, 45};
  const Street::View view = street.view(driver, 96, 54, 500, executor);
  Image rays(Format::rgba32f, 96, 54);
  for (int y = 0; y < 54; ++y) {
    for (int x = 0; x < 96; ++x) {
      const Street::Sight seen = street.look(driver.position, scene::normalized({(x - 47.5) / 96, (y - 26.5) / 96, -1}));
      for (int k = 0; k < 3; ++k) rays.row<float>(y)[4 * x + k] = static_cast<float>(seen.radiance[k]);
      rays.row<float>(y)[4 * x + 3] = static_cast<float>(seen.distance < 1000 ? seen.distance : 1000);
    }
  }
  std::vector<std::string> lines;
  const auto line = [&](const char* of, const Image& image) {
    lines.push_back(fmt::format("{} 0 {} {}", scene.name, of, capture::hash_of(image).text()));
  };
  line("view colour", view.colour);
  line("view depth", view.depth);
  line("panorama colour", street.panorama(96, 48, {0, 0.05, 0}, executor));
  line("look rays", rays);
  return lines;
}

}  // namespace rainref::night_street
