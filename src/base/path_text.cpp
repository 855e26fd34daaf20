#include "base/path_text.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "rainref/error.h"

namespace rainref {

namespace fs = std::filesystem;

namespace {

constexpr bool has_bytes = std::is_same_v<fs::path::value_type, char>;  // any bytes are a path of POSIX

/// Replaces what no Unicode text has, which a name on Windows may contain: half a surrogate pair.
std::string shown_text(const fs::path& path) {
  std::string shown;
  for (const auto unit : path.native()) shown += unit >= ' ' && unit <= '~' ? static_cast<char>(unit) : '?';
  return shown;
}

}  // namespace

fs::path utf8_path(std::string_view utf8) {
  const std::u8string_view text(reinterpret_cast<const char8_t*>(utf8.data()), utf8.size());
  try {
    return fs::path(text);
  } catch (const std::system_error&) {
    throw Error(ExitCode::usage, fmt::format("'{}': expected a path in UTF-8", utf8));
  }
}

std::string system_path_text(const fs::path& path) {
  try {
    const std::u8string text = path.u8string();
    return {reinterpret_cast<const char*>(text.data()), text.size()};
  } catch (const std::system_error&) {
    return shown_text(path);
  }
}

std::string path_text(const fs::path& path) {
  std::string text = system_path_text(path);
  if constexpr (!has_bytes) std::replace(text.begin(), text.end(), '\\', '/');
  return text;
}

}  // namespace rainref
