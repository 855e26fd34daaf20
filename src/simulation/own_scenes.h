// The scenes that came with rainref: those of the installation that this code was loaded from, wherever it lies now.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rainref::simulation {

/// Their names, "puddle/default.toml", in order; none where none came with it. In a build folder those of the sources. They are found from
/// where this code lies, and, for programs of others that have it linked in, from the module that reads pictures.
std::vector<std::string> own_scenes();
/// The file of the own scene of that name, with or without ".toml" and "scenes/" before it; empty where there is none.
std::filesystem::path own_scene(const std::filesystem::path& named);

/// A scene file as a user names it: the file itself where there is one, or else the own scene of that name. What is neither comes back as
/// it is.
std::filesystem::path find_scene(const std::filesystem::path& named);

/// The scenes below ./scenes, or else own_scenes().
std::vector<std::string> known_scenes();
/// What a user may have meant by a scene that is not there, of those beside it and those known: "; did you mean 'x'?" or "".
std::string did_you_mean_scene(const std::filesystem::path& wrong);

}  // namespace rainref::simulation
