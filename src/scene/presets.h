// Presets: weather and light that are laid over any scene, as files of keys for each effect.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/toml_reader.h"

namespace rainref::scene {

/// The word that names presets among overrides: "preset=storm,night". It is no key of a scene: the keys of the presets take its place.
inline constexpr std::string_view preset_word = "preset";

/// A file such as storm.toml: `kind`, `order` and `sentence`, then a table of keys for each effect that it describes. The keys are those
/// of the effect's variant "corrected".
struct Preset {
  std::string name;      ///< of the file, without .toml
  std::string kind;      ///< "weather" or "light": of each kind a scene takes one
  std::string sentence;  ///< what it shows, without a full stop
  std::int64_t order = 0;
  std::map<std::string, std::vector<RawEntry>> keys;  ///< by effect, in the order of the file
};

/// The presets in a folder, weather before light, each in its order; none if there is no such folder. Throws Error(usage) with the place
/// for a file that is none, Error(io) for one that cannot be read.
std::vector<Preset> read_presets(const std::filesystem::path& folder);

/// Picks presets by their names, "storm" or "storm,night", in the order of the names. Throws Error(usage) for an unknown name, for two of
/// one kind, and for one that does not describe this effect and variant.
std::vector<Preset> presets_for(std::string_view names, std::string_view effect, std::string_view variant,
                                const std::filesystem::path& folder);

}  // namespace rainref::scene
