// What the header of a Radiance picture says of its pixels. OpenImageIO 2.4 hands out the last EXPOSURE alone.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace rainref::image_io {

/// What the pixels of a Radiance picture were multiplied by, for red, green and blue: pixels divided by it are radiance. It is the product
/// of all lines EXPOSURE and COLORCORR of the header, which are cumulative; 1 where there are none. Lines that begin with a space or a tab
/// are of other pictures, out of which this one was made. Source: Greg Ward, "The RADIANCE Picture File Format".
///
/// Throws Error(usage) starting with `file` for a factor that is no number above 0, and for a product beyond the range of a float.
std::array<double, 3> hdr_factors(std::string_view file, std::span<const std::byte> bytes);

}  // namespace rainref::image_io
