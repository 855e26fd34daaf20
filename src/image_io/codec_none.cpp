// For a build without OpenImageIO (RAINREF_IMAGE_IO=OFF): it writes PNG, and that is all.
#include <stdexcept>

#include "image_io/codec.h"
#include "image_io/codec_folder.h"
#include "image_io/png_write.h"
#include "rainref/error.h"

namespace rainref::image_io {
namespace {

std::unique_ptr<PictureReader> open(const char*, std::span<const std::byte>) {
  throw Error(ExitCode::io, "this build of rainref reads no pictures in files: it was made without OpenImageIO");
}
std::optional<std::vector<std::byte>> encode(const char* format, const std::string&, const StoredPicture& picture,
                                             const std::byte* texels) {
  if (std::string_view(format) != "png")
    throw std::runtime_error("this build of rainref was made without OpenImageIO and writes PNG alone");
  const auto width = static_cast<std::size_t>(picture.width), height = static_cast<std::size_t>(picture.height);
  return png_file(width, height, picture.channels.size(), {texels, width * height * picture.texel_bytes()}, picture.colour_space == "sRGB");
}

}  // namespace

const Codec& codec() {
  static constexpr Codec functions{open, encode};
  return functions;
}

std::function<void()> codec_ahead() {
  return [] {};
}
std::string codec_folder() { return ""; }
std::size_t codec_bytes() { return 0; }

}  // namespace rainref::image_io
