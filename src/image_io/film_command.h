// The arguments for ffmpeg.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "image_io/film.h"

namespace rainref::image_io {

/// Arguments for raw pictures from standard input to `output`, in the format of the extension of `film`. Throws Error(usage) like
/// require_film.
std::vector<std::string> film_arguments(const std::filesystem::path& film, int width, int height, FilmRate rate,
                                        const std::filesystem::path& output);

}  // namespace rainref::image_io
