// Writes pictures: PNG for display, EXR for numbers. The same image always gives the same bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "image_io/notes.h"
#include "rainref/image.h"

namespace rainref::image_io {

enum class PngChannels : std::uint8_t { rgb, rgba };

/// Writes an rgba8 or rgba8_srgb image as an 8-bit PNG, row 0 on top; rgb leaves out alpha. Codes are stored unchanged; rgba8_srgb also
/// marks the file as sRGB. Throws Error(io) with the file; no partial file stays.
void write_png(const std::filesystem::path& path, const Image& image, PngChannels channels = PngChannels::rgb, const Notes& notes = {});

/// The bytes of such a file, for a page with embedded pictures. They are the same without OpenImageIO.
std::vector<std::byte> png_bytes(const Image& image, PngChannels channels = PngChannels::rgb, const Notes& notes = {});

/// Channels of an EXR file that come from one image.
struct Layer {
  std::string name_prefix;            ///< "" or a layer's name: "normal" makes normal.X from X
  std::vector<std::string> channels;  ///< names of the image's first channels
  const Image* image = nullptr;       ///< half or float, stored unchanged; all layers have one size
};

/// Writes the layers as one EXR, ZIP-compressed (lossless), row 0 on top; bits are stored unchanged, including NaN and infinity. Throws
/// Error(io) with the file; no partial file stays.
void write_exr(const std::filesystem::path& path, const std::vector<Layer>& layers, const Notes& notes = {});

}  // namespace rainref::image_io
