// What a picture's file says of its picture, as text: PNG's tEXt and iTXt, EXR's attributes of type string.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rainref::image_io {

/// `key`: 1 to 31 printable characters of ASCII, which both kinds of files take. `value`: UTF-8 without a zero byte.
struct Note {
  std::string key, value;
};
using Notes = std::vector<Note>;

/// Whether these first bytes of a file are those of a PNG or an EXR.
bool may_have_notes(std::span<const std::byte> bytes);

/// The value of the first note of this key in the bytes of a PNG or EXR file; nothing where there is none, or the bytes are neither.
/// No texel is decoded. Throws Error(usage) starting with `file` when the note, or an EXR's header, is damaged.
std::optional<std::string> find_note(std::string_view file, std::span<const std::byte> bytes, std::string_view key);

}  // namespace rainref::image_io
