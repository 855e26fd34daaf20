// Mistakes in what happens to a finished buffer: orientation, channel order, encoding, timing.
#pragma once

#include "conformance/deviations.h"

namespace rainref::conformance {

// Of an image with all its levels.
void flip_rows(capture::Array& image);
void flip_columns(capture::Array& image);
void swap_channels(capture::Array& image, int a, int b);
void copy_channel(capture::Array& image, int from, int to);
/// Moves level 0 by whole texels; the edge is repeated.
void shift(capture::Array& image, int dx, int dy);

void add_output_faults(std::vector<Deviation>& out, const capture::PassCase& c, const capture::PassCase* before);

}  // namespace rainref::conformance
