// For a build without OpenImageIO that reads and writes the same files all the same (RAINREF_PICTURES=direct): nothing is loaded.
#include "image_io/codec.h"
#include "image_io/codec_folder.h"
#include "image_io/direct/formats.h"

namespace rainref::image_io {

const Codec& codec() { return direct::table(); }

std::function<void()> codec_ahead() {
  return [] {};
}
std::string codec_folder() { return ""; }
// The libraries are part of the program; what they hold beyond it while a file is written is a few rows.
std::size_t codec_bytes() { return 0; }

}  // namespace rainref::image_io
