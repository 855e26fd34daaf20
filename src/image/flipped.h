// Images between effects, whose row 0 is the bottom, and files, whose first row is the top.
#pragma once

#include "rainref/image.h"

namespace rainref {

/// The same image with its rows in the other order.
Image flipped(const Image& image);
/// The same image.
Image copy_of(const Image& image);

}  // namespace rainref
