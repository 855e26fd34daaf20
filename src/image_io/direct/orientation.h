// How a picture is turned, by what cameras and editors write into it. Turned pictures are refused, so all of these must be found.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rainref::image_io::direct {

/// EXIF's number for a picture that is not turned.
inline constexpr int upright = 1;

/// Tag 0x0112 of the first directory of an EXIF block, which may begin with "Exif"; nothing if it has none or is damaged.
/// Source: TIFF 6.0, section 2.
std::optional<int> exif_orientation(std::span<const std::byte> exif);

/// The EXIF block that ImageMagick and others store in a PNG's text: the word exif, its size, and its bytes as hexadecimal digits.
std::vector<std::byte> exif_of_text(std::string_view text);

/// tiff:Orientation in an XMP packet, as an attribute or an element of a description with an end tag: of another one OpenImageIO reads
/// nothing.
std::optional<int> xmp_orientation(std::string_view xmp);

}  // namespace rainref::image_io::direct
