// Reads the scale of the pixels from the header of a Radiance picture. OpenImageIO 2.4 only returns the last EXPOSURE.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace rainref::image_io {

/// The factors of the pixels of a Radiance picture, for red, green and blue: radiance is the pixel divided by the factor. The factor is the
/// product of all lines EXPOSURE and COLORCORR of the header, which are cumulative; 1 if there are none. Lines that begin with a space or a
/// tab belong to other pictures, from which this one was made. Source: Greg Ward, "The RADIANCE Picture File Format".
///
/// Throws Error(usage) starting with `file` for a factor that is not a number above 0, and for a product beyond the range of float.
std::array<double, 3> hdr_factors(std::string_view file, std::span<const std::byte> bytes);

}  // namespace rainref::image_io
