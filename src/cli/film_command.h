// What ffmpeg is asked for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/film.h"

namespace rainref::cli {

/// ffmpeg's arguments: raw pictures from its standard input to `output`, in the format that the name `film` says. Throws Error(usage) as
/// require_film.
std::vector<std::string> film_arguments(const std::filesystem::path& film, int width, int height, FilmRate rate,
                                        const std::filesystem::path& output);

}  // namespace rainref::cli
