// Conversion between images of effects, whose row 0 is the bottom, and files, whose first row is the top.
#pragma once

#include "base/rows.h"
#include "rainref/image.h"

namespace rainref {

/// The same image with its rows in reverse order.
Image flipped(const Image& image);
/// The upright picture, top row first, of one that is stored with this orientation: a number of EXIF, 1 to 8.
Image turned(const Image& stored, int orientation);
/// A copy of the image.
Image copy_of(const Image& image);
/// Copies into the memory of `to` if that has the same size and format. `rows` runs the work.
void copy_into(Image& to, const Image& image, const Rows& rows = rows_here);

}  // namespace rainref
