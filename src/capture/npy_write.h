// NumPy array files, format 1.0, as used in packs.
#pragma once

#include <cstddef>
#include <vector>

#include "capture/array.h"

namespace rainref::capture {

/// One mip level of an image, (height, width) or (height, width, channels) of the storage type; or records, one structured array with named
/// fields and nameless gaps. C order, little endian.
std::vector<std::byte> npy_bytes(const Array& array, int level);

}  // namespace rainref::capture
