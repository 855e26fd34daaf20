// Pictures through the libraries of their formats, for builds in which OpenImageIO has no place. Texels, metadata and reasons are those of
// OpenImageIO 2.4; tests/image_io/both/direct_test.cpp compares them. Each reader throws std::exception with the reason of a refusal.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "image_io/codec.h"

namespace rainref::image_io::direct {

/// libpng expands palettes, fewer than 8 bits and transparent colours, as OpenImageIO has it do. `bytes` must outlive the reader, here and
/// below.
std::unique_ptr<PictureReader> open_png(std::span<const std::byte> bytes);
/// OpenEXR's C++ reader, in the calling thread: the first part at its full resolution.
std::unique_ptr<PictureReader> open_exr(std::span<const std::byte> bytes);
/// Radiance pictures, with no library: flat rows and the run lengths of each channel. The older run lengths, of whole texels, are read as
/// texels, as OpenImageIO reads them.
std::unique_ptr<PictureReader> open_hdr(std::span<const std::byte> bytes);
/// libjpeg; CMYK becomes RGB.
std::unique_ptr<PictureReader> open_jpeg(std::span<const std::byte> bytes);

/// Codec::encode_exr; the same bytes as OpenImageIO's with the same OpenEXR.
std::optional<std::vector<std::byte>> encode_exr(const std::string& name, const StoredPicture& picture, const std::byte* texels);

/// All of them as a table.
const Codec& table();

}  // namespace rainref::image_io::direct
