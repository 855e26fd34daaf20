// Neon text: glass tubes along the strokes of block letters.
#pragma once

#include "night_street/vec.h"

namespace rainref::night_street {

struct Sign;

/// Radiance of the sign's lit side at (u, v) metres from the lower left corner of its board, from the reader's view. soft in [0, 1] fades
/// the strokes into their mean, so that far signs and rough reflections do not alias.
Vec tube_radiance(const Sign& sign, double width, double height, double u, double v, double soft);

}  // namespace rainref::night_street
