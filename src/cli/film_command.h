// What ffmpeg is asked for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/film.h"

namespace rainref::cli {

/// A program of this name in the folders of PATH, as a shell finds it; "" where there is none.
std::filesystem::path program_in_path(const std::string& name);

/// ffmpeg's arguments: raw pictures from its standard input to `output`, in the format that the name `film` says. Throws Error(usage) as
/// require_film.
std::vector<std::string> film_arguments(const std::filesystem::path& film, int width, int height, FilmRate rate,
                                        const std::filesystem::path& output);

}  // namespace rainref::cli
