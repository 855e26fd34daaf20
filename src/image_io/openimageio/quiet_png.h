// Keeps libpng from printing errors to standard error beside rainref's own error; OpenImageIO does not prevent that.
#pragma once

#include <string>

namespace rainref::image_io {

/// The last refusal of libpng in this thread since the last call; "" if there was none.
std::string take_png_refusal();

}  // namespace rainref::image_io
