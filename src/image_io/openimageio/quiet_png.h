// libpng prints what it finds wrong to standard error, beside our own error, and OpenImageIO lets it.
#pragma once

#include <string>

namespace rainref::image_io {

/// What libpng refused last in this thread, "" where it refused nothing since this was called.
std::string take_png_refusal();

}  // namespace rainref::image_io
