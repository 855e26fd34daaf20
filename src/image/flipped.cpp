#include "image/flipped.h"

#include <cstring>

namespace rainref {

Image flipped(const Image& image) {
  Image out(image.format(), image.width(), image.height());
  const std::size_t bytes = BufferView(image).row_bytes();
  for (int y = 0; y < image.height(); ++y) std::memcpy(out.row_bytes(image.height() - 1 - y), image.row_bytes(y), bytes);
  return out;
}

Image turned(const Image& stored, int orientation) {
  // Where the stored rows and columns lead: 5 to 8 exchange the axes.
  const bool is_across = orientation >= 5, rows_back = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7,
             columns_back = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const int width = stored.width(), height = stored.height();
  Image out(stored.format(), is_across ? height : width, is_across ? width : height);
  const auto bytes = static_cast<std::size_t>(info(stored.format()).texel_bytes());
  for (int y = 0; y < out.height(); ++y) {
    std::byte* to = out.row_bytes(y);
    for (int x = 0; x < out.width(); ++x, to += bytes) {
      const int row = is_across ? x : y, column = is_across ? y : x;
      const std::byte* from = stored.row_bytes(rows_back ? height - 1 - row : row);
      std::memcpy(to, from + bytes * static_cast<std::size_t>(columns_back ? width - 1 - column : column), bytes);
    }
  }
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
