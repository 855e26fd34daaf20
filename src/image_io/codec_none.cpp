// For a build without libraries for pictures (RAINREF_PICTURES=none), and for the small WebAssembly module: it writes PNG alone.
#include <stdexcept>

#include "image_io/codec.h"
#include "image_io/codec_folder.h"
#include "rainref/error.h"

namespace rainref::image_io {
namespace {

std::unique_ptr<PictureReader> open(const char*, std::span<const std::byte>) {
  throw Error(ExitCode::io, "this build of rainref reads no pictures in files: it was made without libraries for them");
}
std::optional<std::vector<std::byte>> encode_exr(const std::string&, const StoredPicture&, const std::byte*) {
  throw std::runtime_error("this build of rainref was made without libraries for pictures and writes PNG alone");
}

}  // namespace

const Codec& codec() {
  static constexpr Codec functions{open, encode_exr};
  return functions;
}

std::function<void()> codec_ahead() {
  return [] {};
}
std::string codec_folder() { return ""; }
std::size_t codec_bytes() { return 0; }

}  // namespace rainref::image_io
