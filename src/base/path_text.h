// Paths and their texts. Text is UTF-8 on every system; a path of Windows is UTF-16.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rainref {

/// The path that a text in UTF-8 names. Every text that is not a literal of ASCII becomes a path here: std::filesystem::path itself takes
/// char for the system's code page. Throws Error(usage) if the system's paths are Unicode and the text is not.
std::filesystem::path utf8_path(std::string_view utf8);

/// A path in UTF-8 with `/` between its names, for messages and data: the same text on every system.
std::string path_text(const std::filesystem::path& path);

/// A path in UTF-8 as other programs of this system expect it: `\` between its names on Windows, and path_text() elsewhere.
std::string system_path_text(const std::filesystem::path& path);

}  // namespace rainref
