// A picture of any size in the place of another size: the part that is kept, and its texels at the new size.
#pragma once

#include <array>
#include <functional>

#include "rainref/image.h"

namespace rainref {

/// Columns and rows.
using Size = std::array<int, 2>;
inline Size size_of(const Image& image) { return {image.width(), image.height()}; }

/// A rectangle of whole texels of a picture with rows from the bottom. `x` and `y`: what is cut on the left and at the bottom.
struct Part {
  int x, y, width, height;
  bool operator==(const Part&) const = default;
};
/// The largest part about the centre that has the shape of `aspect`, a number of columns for a number of rows. Less than a texel too much
/// is kept. An odd texel is cut on the right or at the top.
Part centred_part(Size picture, Size aspect);

/// Writes row y of a picture, four floats a texel.
using ReadRow = std::function<void(int y, float* texels)>;
/// That part of a picture of size `of` in `size` texels, rgba32f. Along each axis, where the new texels are no more: the mean over what a
/// new texel covers, each texel weighted by its covered length. Where they are more: linear interpolation between the two nearest centres,
/// held at the part's edges. Sums are in double, columns before rows, first texel first, so the bits are the same on every machine; a
/// constant picture stays exactly as it is.
Image fitted(const ReadRow& row, Size of, const Part& part, Size size);
/// That part of a picture of size `of` in `size` texels, from a copy of the picture of any size: each new texel is that of
/// the copy in which its centre lies; on a border, the one on the right or above. Any format.
Image fitted_nearest(const Image& copy, Size of, const Part& part, Size size);

}  // namespace rainref
