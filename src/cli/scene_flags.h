// The options that say which scene, and how it is run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/commands.h"

namespace CLI {
class App;
}

namespace rainref::cli {

/// What `run`, `hash`, `pack` and `validate --shadow` take, as text.
struct SceneFlags {
  std::string scene;
  std::optional<std::string> size, simd, frames, threads;
  std::vector<std::string> set;
};

/// SCENE, --frames (`with_frames`), --size, --threads, --simd and --set of a verb.
void add_scene_flags(CLI::App& verb, SceneFlags& flags, bool with_frames = true);

/// What they ask for; selects the SIMD target. Error(usage) for a value that is none.
SceneOptions resolve(const SceneFlags& flags);

}  // namespace rainref::cli
