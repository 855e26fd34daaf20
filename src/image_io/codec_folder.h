// Location of the library that reads pictures and writes EXR. Separate from codec.h, which many files include.
#pragma once

#include <string>

namespace rainref::image_io {

/// The folder of the library that codec() opens, found as codec() finds it; "" if there is none.
std::string codec_folder();

}  // namespace rainref::image_io
