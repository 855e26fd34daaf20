// The profiles that rainref judges by. They are data files that are built into the program.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "math/profile.h"

namespace rainref::judge {

/// "ieee", "vulkan", ...: all but "typical" (what known devices do) and "coarsest" (what no device exceeds), which no port is judged under.
std::vector<std::string> profile_names();
/// The profile of this name; Error(usage) naming the nearest one.
const enclosed::Profile& profile(std::string_view name);
/// Returns a profile that a port may be judged under. Throws Error(usage) for one that is not in profile_names().
const enclosed::Profile& judging_profile(std::string_view name);
/// Describes the known devices for reports: "what known devices do (typical: two NVIDIA chips, ...; outside it lie SwiftShader ...)".
const std::string& typical_words();
/// The text of its data file, with the source of every number.
std::string_view profile_text(std::string_view name);

/// Parses a profile: each TOML key is a member of enclosed::Profile, a bare value or a table with `value` or the parts of an Accuracy; each
/// table has a `source`. Throws Error(usage) with file, line and key for anything else.
enclosed::Profile parse_profile(std::string_view toml, const std::string& file);

namespace detail {
struct EmbeddedProfile {
  std::string_view name, text;
};
const std::vector<EmbeddedProfile>& embedded_profiles();
}  // namespace detail

}  // namespace rainref::judge
