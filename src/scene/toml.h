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

/// Reads a scene file and checks all of it. `overrides` are "key=value" texts: the value is a TOML value, or a bare
/// text where that fails or where the parameter is a text or a choice; a later one of the same key wins, and any of
/// them wins over the file, `effect` and `variant` included.
///
/// Throws Error(usage) for the first problem in the order of the file, then of the overrides: bad TOML; an effect or a
/// variant that is missing or unknown; a key that is unknown, or that this variant does not use; a value of the wrong
/// type, out of range or not finite; a required key that is missing. Throws Error(io) when the file cannot be read.
Config load(const std::filesystem::path& file, const std::vector<std::string>& overrides, const EffectTable& effects);

/// The text of a scene file, cut where it is longer than any scene. Throws Error(io).
std::string read_scene(const std::filesystem::path& file);

/// The same for a text already in memory; `file` names it in messages and gives the directory.
Config parse(std::string_view toml, const std::filesystem::path& file, const std::vector<std::string>& overrides,
             const EffectTable& effects);

/// A value that wins over the scene's, and where it was said: a plan's. Text is what --set takes: a TOML value or a bare text.
struct Override {
  std::string key;
  std::variant<std::string, RawValue> value;
  SourceLocation at;  ///< unknown: --set
};
/// The same for a scene that was read already, by read_toml, so that many of it cost less.
Config parse(const std::vector<RawEntry>& scene, const std::filesystem::path& file, const std::vector<Override>& overrides,
             const EffectTable& effects);

/// The value of a key anew, as parse() takes it from a later override. Not of `effect` and `variant`, on which the other keys hang. Throws
/// as parse(); Error(internal) for a key that the configuration has not.
void give(Config& config, const Override& override);

/// The same of a text that may leave out `effect` and `variant`, for a caller who hands in the pictures himself: the keys `pictures`,
/// which name some, must be empty.
Config parse(const SceneText& scene, const Effect& effect, std::span<const char* const> pictures);

/// The same of any of the effects: the text or `set` says which; "corrected" where no variant is said.
Config parse(const SceneText& scene, const EffectTable& effects);

}  // namespace rainref::scene
