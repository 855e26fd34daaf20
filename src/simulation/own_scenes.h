// The scenes that came with rainref: those of the installation that this code was loaded from, wherever it lies now.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rainref::simulation {

/// Their names, "puddle/default.toml", in order; none where none came with it. In a build folder those of the sources.
std::vector<std::string> own_scenes();

/// A scene file as a user names it: the file itself where there is one, or else the own scene of that name, with or without ".toml" and
/// "scenes/" before it. What is neither comes back as it is.
std::filesystem::path find_scene(const std::filesystem::path& named);

}  // namespace rainref::simulation
