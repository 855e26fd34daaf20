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
  Image out;
  copy_into(out, image);
  return out;
}
void copy_into(Image& to, const Image& image, const Rows& rows) {
  if (to.format() != image.format() || to.width() != image.width() || to.height() != image.height())
    to = Image(image.format(), image.width(), image.height());
  const std::size_t bytes = BufferView(image).row_bytes();
  rows(image.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y) std::memcpy(to.row_bytes(y), image.row_bytes(y), bytes);
  });
}

}  // namespace rainref
