// What the known scenes are, in a sentence each.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rainref::simulation {

struct KnownScene {
  std::string name;      ///< as of known_scenes()
  std::string effect;    ///< "" if its file cannot be read as a scene
  std::string sentence;  ///< scene_sentence() of its file
};
/// The known scenes in order; with `effect`, only those of that effect.
std::vector<KnownScene> scene_index(std::string_view effect = "");

/// The first sentence of the comment at the top of a scene file, without its full stop: "Rain on a puddle"; "" if there is none.
std::string scene_sentence(std::string_view toml);

}  // namespace rainref::simulation
