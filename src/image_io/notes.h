// Text notes in picture files: PNG's tEXt and iTXt, EXR's string attributes.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rainref::image_io {

/// `key`: 1 to 31 printable ASCII characters, which both file types accept. `value`: UTF-8 without a zero byte.
struct Note {
  std::string key, value;
};
using Notes = std::vector<Note>;

/// True if these first bytes of a file are those of a PNG or an EXR.
bool may_have_notes(std::span<const std::byte> bytes);

/// The value of the first note with this key in the bytes of a PNG or EXR file; nothing if there is none, or for other bytes. Decodes no
/// texel. Throws Error(usage) starting with `file` if the note, or an EXR's header, is damaged.
std::optional<std::string> find_note(std::string_view file, std::span<const std::byte> bytes, std::string_view key);

}  // namespace rainref::image_io
