// Where the library lies that reads pictures and writes EXR: apart from codec.h, which many include.
#pragma once

#include <string>

namespace rainref::image_io {

/// The folder of the library that codec() opens, found as codec() finds it; "" where there is none.
std::string codec_folder();

}  // namespace rainref::image_io
