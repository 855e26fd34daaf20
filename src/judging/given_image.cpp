#include "judging/given_image.h"

#include <algorithm>
#include <cstring>

#include "image/code_range.h"
#include "math/half.h"
#include "math/unorm.h"

namespace rainref::judging {
namespace {

using Kind = FormatInfo::Kind;

template <class T>
T loaded(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

/// True if these floats are rounded to the output's format.
bool are_stored(const port_dump::StoredImage& given, Kind to) {
  const auto all_are = [&](std::initializer_list<Kind> kinds) {
    return std::all_of(given.channels.begin(), given.channels.end(), [&](const port_dump::StoredImage::Channel& c) {
      return std::find(kinds.begin(), kinds.end(), c.kind) != kinds.end();
    });
  };
  return to == Kind::float16 ? all_are({Kind::float32})
                             : (to == Kind::unorm8 || to == Kind::srgb8) && all_are({Kind::float16, Kind::float32});
}

void store(float value, Kind to, std::size_t channel, std::byte* out) {
  if (to == Kind::float16) {
    const Half half = to_half(value);
    std::memcpy(out, &half.bits, sizeof half.bits);
  } else if (to == Kind::srgb8 && channel < 3 && value == value) {
    *out = static_cast<std::byte>(enclosed::code_range(Kind::srgb8, enclosed::Enclosure(value), {}).lo);
  } else {
    *out = static_cast<std::byte>(to_unorm8(value).code);
  }
}

}  // namespace

std::vector<std::byte> canonical_image(const port_dump::StoredImage& given, const capture::Array& expected, port_dump::ReadNotes& notes) {
  const FormatInfo& format = info(expected.format);
  if (!are_stored(given, format.kind)) return canonical_level(given, expected, 0, notes);
  port_dump::check_level_size(given.file, given.width, given.height, expected, 0);
  port_dump::StoredImage as_stored = given;
  as_stored.set_channels(format.kind, given.channels.size());
  as_stored.row_pitch = as_stored.width * as_stored.texel_bytes;
  std::vector<std::byte> texels(as_stored.height * as_stored.row_pitch);
  as_stored.rows = texels;
  for (std::size_t y = 0; y < given.height; ++y) {
    for (std::size_t x = 0; x < given.width; ++x) {
      const std::byte* const from = given.rows.data() + y * given.row_pitch + x * given.texel_bytes;
      std::byte* const to = texels.data() + y * as_stored.row_pitch + x * as_stored.texel_bytes;
      for (std::size_t c = 0; c < given.channels.size(); ++c) {
        const port_dump::StoredImage::Channel& channel = given.channels[c];
        const std::byte* const value = from + channel.offset;
        store(channel.kind == Kind::float16 ? to_float(loaded<Half>(value)) : loaded<float>(value), format.kind, c,
              to + as_stored.channels[c].offset);
      }
    }
  }
  return canonical_level(as_stored, expected, 0, notes);
}

}  // namespace rainref::judging
