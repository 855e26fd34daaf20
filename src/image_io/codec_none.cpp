// For a build without OpenImageIO (RAINREF_IMAGE_IO=OFF).
#include "image_io/codec.h"
#include "rainref/error.h"

namespace rainref::image_io {

const Codec& codec() {
  throw Error(ExitCode::io, "this build of rainref reads and writes no pictures in files: it was made without OpenImageIO");
}

}  // namespace rainref::image_io
