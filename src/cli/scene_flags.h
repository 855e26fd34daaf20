// Options that select a scene and how to run it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/commands.h"

namespace CLI {
class App;
}

namespace rainref::cli {

/// Values of the options of `run`, `hash`, `pack` and `validate --shadow`, as text.
struct SceneFlags {
  std::string scene;
  std::optional<std::string> size, simd, frames, threads;
  std::vector<std::string> set;
};

/// Adds SCENE, --frames (`with_frames`), --size, --threads, --simd and --set to a verb.
void add_scene_flags(CLI::App& verb, SceneFlags& flags, bool with_frames = true);

/// Converts the values and selects the SIMD target. Error(usage) for an invalid value.
SceneOptions resolve(const SceneFlags& flags);

}  // namespace rainref::cli
