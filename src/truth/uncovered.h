// A picture with depths without what stands before the glass.
#pragma once

#include "rainref/image.h"

namespace rainref::truth {

struct Uncovered {
  Image colour;  ///< rgba32f
  Image depth;   ///< r32f [m]
};

/// What a picture (rgba32f, with depths r32f) shows behind the glass, whose depth in each texel is channel 2 of `surface` (rgba32f). What
/// something nearer hides is not known: it is taken to be like the nearest texel of the row that is behind the glass, the left one of two,
/// and a row without any like the nearest row with some, the lower one of two. Where nothing is behind the glass the picture stays.
Uncovered uncovered(const Image& colour, const Image& depth, const Image& surface);

}  // namespace rainref::truth
