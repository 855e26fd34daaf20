// A mip level as a file stores it, and a check that its values are those of the buffer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "capture/array.h"
#include "port_dump/kept.h"
#include "rainref/image.h"

namespace rainref::port_dump {

/// Notes about an accepted file for the reader of the report, one sentence each, with the file; and what its form leaves open.
struct ReadNotes {
  std::vector<std::string> lines;
  KeptForm kept;  ///< of the buffer that was read last
};

/// Texels in memory that outlives this. Integers and floats are little endian.
struct StoredImage {
  struct Channel {
    FormatInfo::Kind kind;  ///< unorm8 means 8-bit codes of either encoding
    std::size_t offset;     ///< offset in a texel
  };
  std::string file;  ///< quoted, for messages
  std::size_t width = 0, height = 0;
  std::vector<Channel> channels;  ///< red, green, blue, alpha, as far as present
  std::size_t texel_bytes = 0;
  std::size_t row_pitch = 0;  ///< distance of rows [byte]
  std::span<const std::byte> rows;
  bool bottom_up = false;  ///< the last stored row is row 0

  /// Sets this number of channels of one kind, side by side.
  void set_channels(FormatInfo::Kind kind, std::size_t count);
};

/// The buffer's fourth channel: stored, or the constant 1, which an image of three channels omits.
enum class Alpha : std::uint8_t { stored, one };

/// The kinds of values that a file may hold: the buffer's own, or any (encoding.h).
enum class Kinds : std::uint8_t { own, any };
/// The format of this kind with the fewest channels that has `channels` of them; nothing if none has.
std::optional<Format> format_of(FormatInfo::Kind kind, int channels);

/// Stores a value as a half, a float or else an 8-bit code, rounded to nearest.
void put_value(FormatInfo::Kind kind, float value, std::byte* out);

/// "halves", "8-bit codes": for messages.
std::string kind_text(FormatInfo::Kind kind);

/// Throws Error(port_files) unless width x height is the size of this level of the expected buffer; the message notes if rows look padded
/// to a multiple of 64 bytes.
void check_level_size(const std::string& file, std::size_t width, std::size_t height, const capture::Array& expected, int level);

/// The canonical bytes of this level of the expected buffer: rows from v = 0, no padding. Values keep their bits; a float is accepted for a
/// half only if it equals one (a NaN becomes the half NaN of its sign). Channels beyond the buffer's are ignored and named in the notes.
/// With Alpha::one three channels are accepted for four, with a note.
///
/// Throws Error(port_files) if size, channels or type differ, if the file has less precision than the buffer, or if a float is no half; the
/// message gives the texel.
std::vector<std::byte> canonical_level(const StoredImage& stored, const capture::Array& expected, int level, ReadNotes& notes,
                                       Alpha alpha = Alpha::stored);

}  // namespace rainref::port_dump
