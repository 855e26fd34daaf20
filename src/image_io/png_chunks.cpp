#include "image_io/png_chunks.h"

#include <cstring>

#include <fmt/format.h>
#include <zlib.h>

#include "rainref/error.h"

namespace rainref::image_io {

namespace {

constexpr std::size_t signature = 8, length_and_type = 8, checksum = 4;

std::uint32_t big_endian(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
  return value;
}

/// Calls f(type, offset of its data) for each chunk that lies within the bytes, until f returns true.
template <class F>
bool any_chunk(std::span<const std::byte> bytes, F&& f) {
  std::size_t at = signature;
  while (at + length_and_type + checksum <= bytes.size()) {
    const std::size_t end = at + length_and_type + big_endian(bytes, at) + checksum;
    if (end > bytes.size()) return false;
    if (f(reinterpret_cast<const char*>(&bytes[at + 4]), at + length_and_type)) return true;
    at = end;
  }
  return false;
}

bool is(const char* type, const char* name) { return std::memcmp(type, name, 4) == 0; }

}  // namespace

bool png_is_whole(std::span<const std::byte> bytes) {
  return any_chunk(bytes, [](const char* type, std::size_t) { return is(type, "IEND"); });
}

std::optional<PngHeader> parse_png_header(std::span<const std::byte> bytes) {
  constexpr std::size_t data = signature + length_and_type, data_bytes = 13;
  if (bytes.size() < data + data_bytes + checksum || big_endian(bytes, signature) != data_bytes) return std::nullopt;
  if (!is(reinterpret_cast<const char*>(&bytes[signature + 4]), "IHDR")) return std::nullopt;
  return PngHeader{big_endian(bytes, data), big_endian(bytes, data + 4), std::to_integer<int>(bytes[data + 8]),
                   std::to_integer<int>(bytes[data + 9]), any_chunk(bytes, [](const char* type, std::size_t) { return is(type, "tRNS"); })};
}

std::uint32_t png_checksum(std::span<const std::byte> type_and_content) {
  const auto* const bytes = reinterpret_cast<const Bytef*>(type_and_content.data());
  return static_cast<std::uint32_t>(::crc32_z(0, bytes, type_and_content.size()));
}

std::optional<std::string> find_png_text(std::string_view file, std::span<const std::byte> bytes, std::string_view keyword) {
  std::optional<std::string> found;
  any_chunk(bytes, [&](const char* type, std::size_t at) {
    if (!is(type, "tEXt") && !is(type, "iTXt")) return false;
    const std::size_t size = big_endian(bytes, at - length_and_type);
    std::string_view content(reinterpret_cast<const char*>(bytes.data()) + at, size);
    if (!content.starts_with(keyword) || content.size() == keyword.size() || content[keyword.size()] != 0) return false;
    content.remove_prefix(keyword.size() + 1);
    if (is(type, "iTXt")) {
      // Two bytes of compression, a language, the translated keyword.
      if (content.size() < 2 || content[0] != 0) return false;
      content.remove_prefix(2);
      for (int k = 0; k < 2; ++k) {
        const std::size_t end = content.find(char(0));
        if (end == std::string_view::npos) return false;
        content.remove_prefix(end + 1);
      }
    }
    if (png_checksum(bytes.subspan(at - 4, size + 4)) != big_endian(bytes, at + size))
      throw Error(ExitCode::usage, fmt::format("{}: damaged: the checksum of its text '{}' is wrong", file, keyword));
    found = content;
    return true;
  });
  return found;
}

}  // namespace rainref::image_io
