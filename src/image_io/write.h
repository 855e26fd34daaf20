// Writing pictures: PNG for the eye, EXR for numbers. The same image gives the same bytes at any time.
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

/// Writes an rgba8 or rgba8_srgb image as an 8-bit PNG, row 0 on top; rgb leaves alpha out. Codes are stored as they
/// are; rgba8_srgb also marks the file as sRGB. Throws Error(io) naming the file; nothing half-written stays behind.
void write_png(const std::filesystem::path& path, const Image& image, PngChannels channels = PngChannels::rgb, const Notes& notes = {});

/// The bytes of such a file, for a page that holds its pictures. Without OpenImageIO they are the same.
std::vector<std::byte> png_bytes(const Image& image, PngChannels channels = PngChannels::rgb, const Notes& notes = {});

/// Channels of an EXR file that come from one image.
struct Layer {
  std::string name_prefix;            ///< "" or a layer's name: "normal" makes normal.X of X
  std::vector<std::string> channels;  ///< a name for each of the image's first channels
  const Image* image = nullptr;       ///< half or float, which the file keeps; all layers have one size
};

/// Writes the layers as one EXR, ZIP-compressed (lossless), row 0 on top; bits are stored as they are, NaN and infinity
/// too. Throws Error(io) naming the file; nothing half-written stays behind.
void write_exr(const std::filesystem::path& path, const std::vector<Layer>& layers, const Notes& notes = {});

}  // namespace rainref::image_io
