// The arguments for ffmpeg.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/film.h"

namespace rainref::cli {

/// Arguments for raw pictures from standard input to `output`, in the format of the extension of `film`. Throws Error(usage) like
/// require_film.
std::vector<std::string> film_arguments(const std::filesystem::path& film, int width, int height, FilmRate rate,
                                        const std::filesystem::path& output);

}  // namespace rainref::cli
