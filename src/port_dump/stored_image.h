// A mip level as some file stores it, and the one place that decides whether its values are the buffer's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "capture/array.h"
#include "rainref/image.h"

namespace rainref::port_dump {

/// What a reader of the report should know about a file that was accepted: one sentence each, naming the file.
struct ReadNotes {
  std::vector<std::string> lines;
};

/// Texels somewhere in memory that outlives this. Integers and floats are little endian.
struct StoredImage {
  struct Channel {
    FormatInfo::Kind kind;  ///< unorm8 stands for 8-bit codes of either encoding
    std::size_t offset;     ///< in a texel
  };
  std::string file;  ///< quoted, for messages
  std::size_t width = 0, height = 0;
  std::vector<Channel> channels;  ///< red, green, blue, alpha, as many as there are
  std::size_t texel_bytes = 0;
  std::size_t row_pitch = 0;  ///< bytes from row to row
  std::span<const std::byte> rows;
  bool bottom_up = false;  ///< the last row stored is row 0

  /// As many channels of one kind, side by side.
  void set_channels(FormatInfo::Kind kind, std::size_t count);
};

/// What the buffer's fourth channel is: what was stored, or the constant 1, which a picture of three channels leaves out.
enum class Alpha : std::uint8_t { stored, one };

/// "halves", "8-bit codes": for messages.
std::string kind_text(FormatInfo::Kind kind);

/// Throws Error(port_files) unless width x height is the size of this level of the expected buffer; the message says where rows look
/// padded to a multiple of 64 bytes.
void check_level_size(const std::string& file, std::size_t width, std::size_t height, const capture::Array& expected, int level);

/// The canonical bytes of this level of the expected buffer: rows from v = 0, no padding. Values keep their bits; a
/// float is taken for a half only when it equals one (a NaN becomes the half NaN of its sign). Channels beyond the
/// buffer's are left out and named in the notes. With Alpha::one three channels are taken for four, which the notes say.
///
/// Throws Error(port_files) when size, channels or type differ, when the file stores less precision than the buffer, or
/// when a float is no half; the message gives the texel.
std::vector<std::byte> canonical_level(const StoredImage& stored, const capture::Array& expected, int level, ReadNotes& notes,
                                       Alpha alpha = Alpha::stored);

}  // namespace rainref::port_dump
