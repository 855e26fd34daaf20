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
  std::vector<std::string> presets, set;
};

/// Adds SCENE, --frames (`with_frames`), --size, --threads, --simd, --preset and --set to a verb.
void add_scene_flags(CLI::App& verb, SceneFlags& flags, bool with_frames = true);
/// Adds --preset, which may be given several times.
void add_preset_flag(CLI::App& verb, std::vector<std::string>& presets, const std::string& before = "");
/// The override that stands for these presets; none where there are none.
std::vector<std::string> preset_override(const std::vector<std::string>& presets);

/// Converts the values and selects the SIMD target. Error(usage) for an invalid value.
SceneOptions resolve(const SceneFlags& flags);

}  // namespace rainref::cli
