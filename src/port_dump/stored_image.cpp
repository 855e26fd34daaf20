#include "port_dump/stored_image.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "math/half.h"
#include "math/unorm.h"
#include "rainref/error.h"

namespace rainref::port_dump {
namespace {

using Kind = FormatInfo::Kind;

constexpr std::string_view channel_names = "rgba";

[[noreturn]] void refuse(const StoredImage& stored, const std::string& why) {
  throw Error(ExitCode::port_files, fmt::format("{}: {}", stored.file, why));
}

// Why a channel of kind `found` cannot hold the values of a buffer of this format, or "".
std::string mismatch(Kind found, Format format) {
  const Kind expected = info(format).kind;
  const bool codes = expected == Kind::unorm8 || expected == Kind::srgb8;
  if (found == expected || (codes && found == Kind::unorm8)) return "";
  if (expected == Kind::float16 && found == Kind::float32) return "";
  std::string why = fmt::format("expected {} as {}, found {}", info(format).name, kind_text(expected), kind_text(found));
  if (expected == Kind::float32 && found == Kind::float16)
    why += ": the exporter has rounded; export floats";
  else if (codes)
    why += ": a copy of the codes in another type has been converted";
  else if (found == Kind::unorm8)
    why += ": the exporter has quantized";
  return why;
}

void check_channels(const StoredImage& stored, Format format, Alpha alpha, ReadNotes& notes) {
  const auto wanted = static_cast<std::size_t>(info(format).channels), found = stored.channels.size();
  const bool lacks_one = alpha == Alpha::one && wanted == 4 && found == 3;
  if (found < wanted && !lacks_one) {
    refuse(stored, fmt::format("expected {} channels of {}, found {}", wanted, info(format).name, found));
  }
  if (lacks_one) notes.lines.push_back(fmt::format("{}: 3 channels, the buffer's fourth is 1 everywhere: taken as 1", stored.file));
  for (std::size_t c = 0; c < std::min(wanted, found); ++c) {
    if (const std::string why = mismatch(stored.channels[c].kind, format); !why.empty()) refuse(stored, why);
  }
  if (found > wanted) {
    notes.lines.push_back(fmt::format("{}: {} channels, the buffer has {}: {} not read", stored.file, found, wanted,
                                      channel_names.substr(wanted, found - wanted)));
  }
}

template <class T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

// The half that equals the float at `from`.
std::uint16_t exact_half(const StoredImage& stored, const std::byte* from, std::size_t x, std::size_t y, std::size_t c) {
  const auto value = load<float>(from);
  const Half half = to_half(value);
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const bool is_nan = (bits & 0x7fffffffu) > 0x7f800000u;
  if (!is_nan && std::bit_cast<std::uint32_t>(to_float(half)) != bits) {
    refuse(stored, fmt::format("texel x {}, y {}, channel {} is {} (0x{:08x}), which no half equals; the buffer stores halves, "
                               "so these are not its values",
                               x, y, channel_names[c], value, bits));
  }
  return half.bits;
}

// True for texels of the same size with channels at the same offsets. For the kinds that check_channels accepts, the bytes are then the
// same.
bool is_same_layout(const StoredImage& stored, const FormatInfo& format) {
  if (stored.texel_bytes != static_cast<std::size_t>(format.texel_bytes())) return false;
  if (stored.channels.size() < static_cast<std::size_t>(format.channels)) return false;
  for (int c = 0; c < format.channels; ++c) {
    if (stored.channels[c].offset != static_cast<std::size_t>(c * format.channel_bytes)) return false;
  }
  return true;
}

void copy_row(const StoredImage& stored, const FormatInfo& format, std::size_t y, const std::byte* in, std::byte* out) {
  const auto bytes = static_cast<std::size_t>(format.channel_bytes);
  for (std::size_t x = 0; x < stored.width; ++x, in += stored.texel_bytes) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(format.channels); ++c, out += bytes) {
      if (c >= stored.channels.size()) {
        put_value(format.kind, 1, out);
        continue;
      }
      const StoredImage::Channel& channel = stored.channels[c];
      if (format.kind == Kind::float16 && channel.kind == Kind::float32) {
        const std::uint16_t half = exact_half(stored, in + channel.offset, x, y, c);
        std::memcpy(out, &half, sizeof half);
      } else {
        std::memcpy(out, in + channel.offset, bytes);
      }
    }
  }
}

}  // namespace

void put_value(FormatInfo::Kind kind, float value, std::byte* out) {
  const Half half = to_half(value);
  const Unorm8 code = to_unorm8(value);
  if (kind == FormatInfo::float32)
    std::memcpy(out, &value, sizeof value);
  else if (kind == FormatInfo::float16)
    std::memcpy(out, &half, sizeof half);
  else
    std::memcpy(out, &code, sizeof code);
}

void check_level_size(const std::string& file, std::size_t width, std::size_t height, const capture::Array& expected, int level) {
  const auto wanted_width = static_cast<std::size_t>(expected.level_width(level));
  const auto wanted_height = static_cast<std::size_t>(expected.level_height(level));
  if (width == wanted_width && height == wanted_height) return;
  std::string hint;
  if (width == wanted_height && height == wanted_width) hint = "; width and height are exchanged (NPY shapes are height, width)";
  const std::size_t row = wanted_width * expected.element_bytes();
  if (height == wanted_height && width > wanted_width && !expected.is_records)
    for (const std::size_t pitch : {64, 128, 256, 512})
      if (hint.empty() && width * expected.element_bytes() == (row + pitch - 1) / pitch * pitch)
        hint = fmt::format("; rows of {} bytes are padded to multiples of {}: save the first {} texels of each", row, pitch, wanted_width);
  throw Error(ExitCode::port_files,
              fmt::format("{}: expected {}x{} texels, found {}x{}{}", file, wanted_width, wanted_height, width, height, hint));
}

void StoredImage::set_channels(FormatInfo::Kind kind, std::size_t count) {
  const std::size_t bytes = kind == Kind::unorm8 || kind == Kind::srgb8 ? 1 : kind == Kind::float16 ? 2 : 4;
  channels.clear();
  for (std::size_t c = 0; c < count; ++c) channels.push_back({kind == Kind::srgb8 ? Kind::unorm8 : kind, c * bytes});
  texel_bytes = count * bytes;
}

std::optional<Format> format_of(FormatInfo::Kind kind, int channels) {
  std::optional<Format> best;
  for (int i = 0; i <= static_cast<int>(Format::r32ui); ++i) {
    const FormatInfo& f = info(static_cast<Format>(i));
    if (f.kind != kind || f.channels < channels || (best && f.channels >= info(*best).channels)) continue;
    best = static_cast<Format>(i);
  }
  return best;
}

std::string kind_text(FormatInfo::Kind kind) {
  switch (kind) {
    case Kind::unorm8:
    case Kind::srgb8:
      return "8-bit codes";
    case Kind::float16:
      return "halves";
    case Kind::float32:
      return "floats";
    case Kind::uint32:
      return "32-bit unsigned integers";
  }
  return "";
}

std::vector<std::byte> canonical_level(const StoredImage& stored, const capture::Array& expected, int level, ReadNotes& notes,
                                       Alpha alpha) {
  check_level_size(stored.file, stored.width, stored.height, expected, level);
  check_channels(stored, expected.format, alpha, notes);
  const FormatInfo& format = info(expected.format);
  // Readers have checked this against their own headers; this keeps a defect there from reading out of bounds.
  if (stored.height > 0 && stored.rows.size() < (stored.height - 1) * stored.row_pitch + stored.width * stored.texel_bytes) {
    throw Error(ExitCode::internal, fmt::format("{}: rows do not lie in the file", stored.file));
  }
  const std::size_t row_bytes = stored.width * format.texel_bytes();
  std::vector<std::byte> out(stored.height * row_bytes);
  const bool same = is_same_layout(stored, format);
  for (std::size_t y = 0; y < stored.height; ++y) {
    const std::byte* in = stored.rows.data() + (stored.bottom_up ? stored.height - 1 - y : y) * stored.row_pitch;
    if (same) {
      std::memcpy(out.data() + y * row_bytes, in, row_bytes);
    } else {
      copy_row(stored, format, y, in, out.data() + y * row_bytes);
    }
  }
  return out;
}

}  // namespace rainref::port_dump
