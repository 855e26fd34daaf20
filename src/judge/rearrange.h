// Images that are flipped, moved or have their channels exchanged: common errors between a port and its files.
#pragma once

#include <cstddef>
#include <vector>

#include "capture/array.h"

namespace rainref::judge {

/// Calls change(texel) with the bytes of every texel of every level.
template <class Change>
void each_texel(capture::Array& a, Change change) {
  const std::size_t n = a.element_bytes();
  for (capture::Bytes& level : a.levels) {
    std::vector<std::byte>& texels = level.edit();
    for (std::size_t t = 0; t + n <= texels.size(); t += n) change(texels.data() + t);
  }
}
// For an image with all its levels.
void flip_rows(capture::Array& image);
void flip_columns(capture::Array& image);
void swap_channels(capture::Array& image, int a, int b);
void copy_channel(capture::Array& image, int from, int to);
/// Moves level 0 by whole texels, repeating the edge.
void shift(capture::Array& image, int dx, int dy);
/// Exchanges rows and columns of the largest square at the origin of level 0.
void transpose(capture::Array& image);

}  // namespace rainref::judge
