#include "image_io/direct/orientation.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace rainref::image_io::direct {
namespace {

/// Numbers of a TIFF structure in its own order of bytes; 0 beyond its end.
class Tiff {
 public:
  Tiff(std::span<const std::byte> bytes, bool is_little) : bytes_(bytes), is_little_(is_little) {}

  std::uint32_t number(std::size_t at, std::size_t size) const {
    if (at > bytes_.size() || size > bytes_.size() - at) return 0;
    std::uint32_t out = 0;
    for (std::size_t i = 0; i < size; ++i) out = out << 8 | std::to_integer<std::uint32_t>(bytes_[at + (is_little_ ? size - 1 - i : i)]);
    return out;
  }

 private:
  std::span<const std::byte> bytes_;
  bool is_little_;
};

/// The first number of an entry; nothing if it is none, or lies beyond the end; 0, which is no orientation, for an entry without numbers.
std::optional<int> value_of(const Tiff& tiff, std::size_t entry, std::size_t end) {
  const std::uint32_t type = tiff.number(entry + 2, 2), count = tiff.number(entry + 4, 4);
  const std::size_t size = type == 1 ? 1 : type == 3 ? 2 : type == 4 ? 4 : 0, bytes = size * count;
  if (size > 1 && count == 0) return 0;
  if (bytes == 0 || (size == 1 && count != 1)) return std::nullopt;
  // What needs more than four bytes stands elsewhere.
  const std::size_t at = bytes <= 4 ? entry + 8 : tiff.number(entry + 8, 4);
  if (at + bytes > end) return std::nullopt;
  return static_cast<int>(tiff.number(at, size));
}

int digit_of(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

std::optional<int> exif_orientation(std::span<const std::byte> exif) {
  constexpr std::string_view prefix("Exif\0\0", 6);
  if (exif.size() >= prefix.size() && std::memcmp(exif.data(), prefix.data(), prefix.size()) == 0) exif = exif.subspan(prefix.size());
  constexpr std::size_t header = 8, entry = 12;
  if (exif.size() < header || exif[0] != exif[1] || (exif[0] != std::byte{'I'} && exif[0] != std::byte{'M'})) return std::nullopt;
  const Tiff tiff(exif, exif[0] == std::byte{'I'});
  const std::size_t directory = tiff.number(4, 4);
  const std::uint32_t count = tiff.number(directory, 2);
  if (directory + 2 + count * entry > exif.size()) return std::nullopt;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t at = directory + 2 + i * entry;
    if (at + entry >= exif.size()) break;  // behind the last entry stands the next directory's offset
    if (tiff.number(at, 2) == 0x0112) return value_of(tiff, at, exif.size());
  }
  return std::nullopt;
}

std::vector<std::byte> exif_of_text(std::string_view text) {
  constexpr std::string_view spaces = " \t\r\n", name = "exif";
  const auto skip = [&](std::string_view set) { text.remove_prefix(std::min(text.find_first_not_of(set), text.size())); };
  std::vector<std::byte> out;
  skip(spaces);
  if (!text.starts_with(name)) return out;
  text.remove_prefix(name.size());
  skip(spaces);
  skip("0123456789");  // the size, which the digits have, too
  int high = -1;
  for (const char c : text) {
    const int digit = digit_of(c);
    if (digit < 0) continue;
    if (high >= 0) out.push_back(static_cast<std::byte>(high << 4 | digit));
    high = high >= 0 ? -1 : digit;
  }
  return out;
}

std::optional<int> xmp_orientation(std::string_view xmp) {
  constexpr std::string_view begin = "<rdf:Description", end = "</rdf:Description>", name = "tiff:Orientation";
  for (std::size_t from = xmp.find(begin); from != std::string_view::npos; from = xmp.find(begin, from + 1)) {
    const std::size_t to = xmp.find(end, from);
    if (to == std::string_view::npos) return std::nullopt;
    const std::string_view part = xmp.substr(from, to - from);
    const std::size_t found = part.find(name);
    if (found == std::string_view::npos) continue;
    const std::string_view value = part.substr(found + name.size());
    const std::size_t at = value.find_first_not_of(" \t\r\n=\"'>");
    if (at == std::string_view::npos || digit_of(value[at]) < 0 || digit_of(value[at]) > 9) return std::nullopt;
    return digit_of(value[at]);
  }
  return std::nullopt;
}

}  // namespace rainref::image_io::direct
