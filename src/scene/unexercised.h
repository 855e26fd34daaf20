// The table `unexercised` of a scene: alternatives that its packs do not exercise. It does not affect any result.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "scene/toml_reader.h"

namespace rainref::scene {

/// For each pass: the alternatives that no run takes, with reasons.
using Unexercised = std::map<std::string, std::map<std::string, std::string>>;

/// True if a key lies in that table.
bool is_unexercised(std::string_view key);
/// Reads `PASS = [["alternative", "reason"], ...]`. Throws Error(usage) for anything else, and for a repeated alternative.
void take_unexercised(const RawEntry& raw, Unexercised& to);
/// Reads the table of a text and skips other tables. Throws as read_toml and take_unexercised do.
Unexercised unexercised(std::string_view toml, const std::string& file);

}  // namespace rainref::scene
