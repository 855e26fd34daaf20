#include "image/flipped.h"

#include <cstring>

namespace rainref {

Image flipped(const Image& image) {
  Image out(image.format(), image.width(), image.height());
  const std::size_t bytes = BufferView(image).row_bytes();
  for (int y = 0; y < image.height(); ++y) std::memcpy(out.row_bytes(image.height() - 1 - y), image.row_bytes(y), bytes);
  return out;
}

Image copy_of(const Image& image) {
  Image out(image.format(), image.width(), image.height());
  const std::size_t bytes = BufferView(image).row_bytes();
  for (int y = 0; y < image.height(); ++y) std::memcpy(out.row_bytes(y), image.row_bytes(y), bytes);
  return out;
}

}  // namespace rainref
