// The bundled scenes: those of the installation that contains this code, wherever it is now.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rainref::simulation {

/// Their names in order, "puddle/default.toml"; none if there are none. In a build folder they are the scenes of the sources. They are
/// found from the location of this code. If another program has linked this code statically, they are found from the module that reads
/// pictures.
std::vector<std::string> own_scenes();
/// The file of the bundled scene of that name, with or without ".toml" and "scenes/" before it; empty if there is none.
std::filesystem::path own_scene(const std::filesystem::path& named);
/// A folder of that name beside the bundled scenes, such as "demo"; empty if there is none.
std::filesystem::path own_data(const std::string& name);

/// Resolves a scene name given by a user: the file itself if it exists, else the bundled scene of that name, else the name unchanged.
std::filesystem::path find_scene(const std::filesystem::path& named);

/// The scenes below ./scenes; if there are none, own_scenes().
std::vector<std::string> known_scenes();
/// "; did you mean 'x'?" for the nearest of the scenes beside the missing one and the known scenes, or "".
std::string did_you_mean_scene(const std::filesystem::path& wrong);

}  // namespace rainref::simulation
