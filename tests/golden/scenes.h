// Every golden scene, whichever effect it is of.
#pragma once

#include <functional>
#include <utility>
#include <string>
#include <vector>

#include "edge_splash/golden_scenes.h"
#include "golden/lines.h"
#include "night_street/golden_scenes.h"
#include "puddle/golden_scenes.h"
#include "rainy_glass/golden_scenes.h"
#include "screen_drops/golden_scenes.h"
#include "truth/golden_scenes.h"
#include "windshield/golden_scenes.h"

namespace rainref::golden {

struct Scene {
  std::string name;
  /// Its lines of so many frames, 60 for all.
  std::function<std::vector<std::string>(const parallel::Executor& executor, int frames, const Caller& caller)> lines;
};

template <class OfAnEffect>
std::vector<Scene> all_of(const std::vector<OfAnEffect>& scenes) {
  std::vector<Scene> all;
  for (const OfAnEffect& scene : scenes) {
    all.push_back({scene.name, [scene](const parallel::Executor& executor, int frames, const Caller& caller) {
                     return golden_lines(scene, executor, frames, caller);
                   }});
  }
  return all;
}

/// With what their names begin: an effect's name, "compositor" for traced pictures, "night_street" for what scenes without pictures show.
inline const std::vector<std::pair<std::string, std::vector<Scene>>>& scenes() {
  static const std::vector<std::pair<std::string, std::vector<Scene>>> all{{"puddle", all_of(puddle::golden_scenes())},
                                                                           {"windshield", all_of(windshield::golden_scenes())},
                                                                           {"edge_splash", all_of(edge_splash::golden_scenes())},
                                                                           {"screen_drops", all_of(screen_drops::golden_scenes())},
                                                                           {"rainy_glass", all_of(rainy_glass::golden_scenes())},
                                                                           {"compositor", all_of(truth::golden_scenes())},
                                                                           {"night_street", all_of(night_street::golden_scenes())}};
  return all;
}

}  // namespace rainref::golden
