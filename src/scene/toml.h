// Scene files: TOML plus the command line's --set, checked key by key against the declared parameters.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "rainref/scene_text.h"
#include "scene/config.h"
#include "scene/effect_table.h"
#include "scene/toml_reader.h"

namespace rainref::scene {

/// Reads a scene file and checks all of it. `overrides` are "key=value" texts. The value is a TOML value, or a bare text if that fails or
/// if the parameter is a text or a choice. A later override of the same key replaces an earlier one, and all replace values of the file,
/// including `effect` and `variant`. "preset=NAME,..." stands for the keys of these presets (scene/presets.h); they replace values of the
/// file, and the other overrides replace theirs.
///
/// Throws Error(usage) for the first problem in the order of the file, then of the overrides: bad TOML; an effect or a variant that is
/// missing or unknown; a key that is unknown, or that this variant does not use; a value of the wrong type, out of range or not finite; a
/// required key that is missing. Throws Error(io) if the file cannot be read.
Config load(const std::filesystem::path& file, const std::vector<std::string>& overrides, const EffectTable& effects);

/// The text of a scene file, cut if it is longer than any scene. Throws Error(io).
std::string read_scene(const std::filesystem::path& file);

/// The same for a text in memory; `file` is its name in messages and gives the directory.
Config parse(std::string_view toml, const std::filesystem::path& file, const std::vector<std::string>& overrides,
             const EffectTable& effects);

/// A value from a plan that replaces the scene's, and its place. The text is that of --set: a TOML value or a bare text.
struct Override {
  std::string key;
  std::variant<std::string, RawValue> value;
  SourceLocation at;  ///< unknown: --set
};
/// The same for a scene already read by read_toml, which is faster for many runs of it.
Config parse(const std::vector<RawEntry>& scene, const std::filesystem::path& file, const std::vector<Override>& overrides,
             const EffectTable& effects);

/// Changes the value of a key, as a later override in parse() does. Not for `effect` and `variant`, which other keys depend on. Throws as
/// parse() does; Error(internal) for a key that the configuration lacks.
void give(Config& config, const Override& override);

/// The same for a text that may lack `effect` and `variant`, for a caller who passes the pictures itself: the keys `pictures`, which name
/// pictures, must be empty.
Config parse(const SceneText& scene, const Effect& effect, std::span<const char* const> pictures);

/// The same for any effect: the text or `set` must name it; the default variant is "corrected".
Config parse(const SceneText& scene, const EffectTable& effects);

}  // namespace rainref::scene
