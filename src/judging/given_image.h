// An image in memory that a port gave, with the port's own texel format.
#pragma once

#include <cstddef>
#include <vector>

#include "port_dump/stored_image.h"

namespace rainref::judging {

/// Converts the texels to the canonical bytes of an output by the rules for files (port_dump::canonical_level), with the same errors and
/// notes. Exception: floats for an output of 8-bit codes, and floats that are not exact halves, are rounded as the output stores them: to
/// nearest even; infinity if too large for a half; sRGB encoded if the output is sRGB, except alpha; NaN gives code 0.
std::vector<std::byte> canonical_image(const port_dump::StoredImage& given, const capture::Array& expected, port_dump::ReadNotes& notes);

}  // namespace rainref::judging
