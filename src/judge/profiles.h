// The profiles that rainref judges by: data files, built into the program.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "math/profile.h"

namespace rainref::judge {

/// "ieee", "vulkan", ...: without "typical" and "coarsest", which nobody is judged under: what known devices do, and what no device does.
std::vector<std::string> profile_names();
/// The profile of this name; Error(usage) naming the nearest one.
const enclosed::Profile& profile(std::string_view name);
/// One that a port may be judged under: Error(usage) for one that is not among profile_names().
const enclosed::Profile& judging_profile(std::string_view name);
/// What known devices do, in words for reports: "what known devices do (typical: two NVIDIA chips, ...; outside it lie SwiftShader ...)".
const std::string& typical_words();
/// The text of its data file, with the source of every number.
std::string_view profile_text(std::string_view name);

/// A profile from TOML: every key is a member of enclosed::Profile, a bare value or a table with `value` or the parts of
/// an Accuracy, and each of those has a `source`. Error(usage) with file, line and key for anything else.
enclosed::Profile parse_profile(std::string_view toml, const std::string& file);

namespace detail {
struct EmbeddedProfile {
  std::string_view name, text;
};
const std::vector<EmbeddedProfile>& embedded_profiles();
}  // namespace detail

}  // namespace rainref::judge
