// An image that a port gave in memory and that says itself what its texels are.
#pragma once

#include <cstddef>
#include <vector>

#include "port_dump/stored_image.h"

namespace rainref::judging {

/// The canonical bytes of an output whose texels are these, by the rule of files (port_dump::canonical_level), with its errors and notes.
/// But floats of an output of 8-bit codes, and floats that no half equals, are stored as the output stores them: to nearest even, an
/// infinity for what is too large for a half; sRGB encoded where it is sRGB, but for alpha; of a NaN code 0.
std::vector<std::byte> canonical_image(const port_dump::StoredImage& given, const capture::Array& expected, port_dump::ReadNotes& notes);

}  // namespace rainref::judging
