// What a scene says of alternatives that its packs do not exercise: the table `unexercised`, which changes nothing that is computed.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "scene/toml_reader.h"

namespace rainref::scene {

/// For each pass the alternatives that no run takes, and why.
using Unexercised = std::map<std::string, std::map<std::string, std::string>>;

/// Whether a key lies in that table.
bool is_unexercised(std::string_view key);
/// Takes `PASS = [["alternative", "reason"], ...]`. Throws Error(usage) for anything else, and for an alternative that is there twice.
void take_unexercised(const RawEntry& raw, Unexercised& to);
/// All of a text's; other tables are passed over. Throws as read_toml and take_unexercised.
Unexercised unexercised(std::string_view toml, const std::string& file);

}  // namespace rainref::scene
