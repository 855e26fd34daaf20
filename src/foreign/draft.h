// The first draft of an effect's description (effect_file.h).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rainref::foreign {

/// A description of these shaders, pass by pass in this order, as far as they say it themselves; "?" stands for what they do not. The
/// passes have the names of the files. Throws Error(io), Error(port_files) and spirv::Refusal for a file that is no shader that can be
/// executed.
std::string draft_of(const std::vector<std::filesystem::path>& shaders);

}  // namespace rainref::foreign
