// What scenes are, in a sentence each.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rainref::simulation {

struct KnownScene {
  std::string name;             ///< as it was given
  std::string effect, variant;  ///< "" if the file cannot be read as a scene
  std::string sentence;         ///< scene_sentence() of the file
};
/// What a scene file, or the scene in a picture, says of itself.
KnownScene known_scene(const std::string& name, const std::filesystem::path& file);
/// The known scenes in order; with `effect`, only those of that effect.
std::vector<KnownScene> scene_index(std::string_view effect = "");

/// The first sentence of the comment at the top of a scene file, without its full stop: "Rain on a puddle"; "" if there is none.
std::string scene_sentence(std::string_view toml);

}  // namespace rainref::simulation
