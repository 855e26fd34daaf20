// The state that OpenImageIO keeps for the whole process, set once to what determinism needs.
#pragma once

namespace rainref::image_io {

/// One thread for OpenImageIO and none for OpenEXR's pool, so that decoding happens on the caller's thread; no filling
/// in of missing pixels; OpenEXR's C++ reader. Overrides the environment (OPENIMAGEIO_OPTIONS). Idempotent.
void configure_openimageio();

}  // namespace rainref::image_io
