// Images between effects, whose row 0 is the bottom, and files, whose first row is the top.
#pragma once

#include "base/rows.h"
#include "rainref/image.h"

namespace rainref {

/// The same image with its rows in the other order.
Image flipped(const Image& image);
/// The same image.
Image copy_of(const Image& image);
/// The same, in the memory of `to` where that has its size and format. `rows` says who does it.
void copy_into(Image& to, const Image& image, const Rows& rows = rows_here);

}  // namespace rainref
