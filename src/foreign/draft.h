// Writes the first draft of an effect's description (effect_file.h).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rainref::foreign {

/// Describes these shaders, one pass each, in this order, from what the modules contain; "?" stands for what they do not. Passes are named
/// after the files. Throws Error(io), Error(port_files), and spirv::Refusal for a file that is not an executable shader.
std::string draft_of(const std::vector<std::filesystem::path>& shaders);

}  // namespace rainref::foreign
