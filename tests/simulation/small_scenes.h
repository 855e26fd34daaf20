// Scenes so small that a frame takes no time.
#pragma once

#include <string>
#include <vector>

#include "base/npy.h"
#include "base/temporary_folder.h"
#include "rainref/scene_text.h"

namespace rainref {

/// A picture of 2 x 1 as a NumPy array: the street's panorama and the asphalt take a second.
inline std::string tiny_picture() {
  static const TemporaryFolder folder;
  static const std::string file = [] {
    put(folder / "tiny.npy", npy("'|u1'", "(1, 2, 3)", "\x20\x40\x60\x80\xa0\xc0"));
    return (folder / "tiny.npy").string();
  }();
  return file;
}

/// A scene so small that a frame takes no time.
inline SceneText small(const std::string& effect, const std::string& variant, std::vector<std::string> more = {}) {
  std::vector<std::string> set{"effect=" + effect, "variant=" + variant, "run.size=[33, 21]"};
  if (effect == "puddle") set.insert(set.end(), {"environment.image=" + tiny_picture(), "puddle.ground_image=" + tiny_picture()});
  if (effect == "puddle" && variant == "corrected") set.insert(set.end(), {"puddle.grid=[61, 45]", "puddle.shape=basin", "rain.rate=80"});
  if (effect == "windshield")
    set.insert(set.end(), {"windshield.height_size=[64, 36]", "scene.size=[32, 18]", "windshield.capacity=3000",
                           variant == "corrected" ? "rain.rate=100" : "windshield.spawn_rate=20000"});
  if (effect == "rainy_glass") set.push_back("maps.size=32");
  set.insert(set.end(), more.begin(), more.end());
  return {"", set};
}

}  // namespace rainref
