#include <string_view>

#include "image_io/direct/formats.h"

namespace rainref::image_io::direct {
namespace {

std::unique_ptr<PictureReader> open(const char* format, std::span<const std::byte> bytes) {
  const std::string_view name = format;
  if (name == "png") return open_png(bytes);
  if (name == "openexr") return open_exr(bytes);
  if (name == "hdr") return open_hdr(bytes);
  if (name == "jpeg") return open_jpeg(bytes);
  return nullptr;
}

}  // namespace

const Codec& table() {
  static constexpr Codec functions{open, encode_exr};
  return functions;
}

}  // namespace rainref::image_io::direct
