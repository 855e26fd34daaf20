// Images of tests: made by a function of the texel, taken as bytes, compared.
#pragma once

#include <string>

#include "rainref/image.h"

namespace rainref {

/// An image filled by f(x, y, channel), which returns the storage type of one channel.
template <class F>
Image make_image(Format format, int width, int height, F&& f) {
  Image image(format, width, height);
  using T = decltype(f(0, 0, 0));
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < width * image.channels(); ++i) {
      image.row<T>(y)[i] = f(i / image.channels(), y, i % image.channels());
    }
  }
  return image;
}

/// The bytes of all texels, row after row, without what lies between rows.
inline std::string bytes_of(const BufferView& image) {
  const std::size_t row = image.row_bytes();
  std::string bytes(row * static_cast<std::size_t>(image.height()), '\0');
  for (int y = 0; y < image.height(); ++y) image.copy_row(y, reinterpret_cast<std::byte*>(&bytes[row * static_cast<std::size_t>(y)]));
  return bytes;
}
/// Whether two images have the same format, the same size and the same bits.
inline bool same(const Image& a, const Image& b) {
  return a.format() == b.format() && a.width() == b.width() && bytes_of(a) == bytes_of(b);
}

}  // namespace rainref
