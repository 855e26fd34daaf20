#include "image_io/openimageio.h"

#include <mutex>

#include <OpenImageIO/imageio.h>

namespace rainref::image_io {

void configure_openimageio() {
  static std::once_flag once;
  std::call_once(once, [] {
    OIIO::attribute("threads", 1);
    // -1: decode in the calling thread. 0 would mean as many threads as cores, 1 a pool of one extra thread.
    OIIO::attribute("exr_threads", -1);
    OIIO::attribute("missingcolor", "");
    OIIO::attribute("openexr:core", 0);
    OIIO::attribute("try_all_readers", 0);
  });
}

}  // namespace rainref::image_io
