#include "image_io/png_chunks.h"

#include <cstdint>
#include <cstring>

namespace rainref::image_io {

bool png_is_whole(std::span<const std::byte> bytes) {
  constexpr std::size_t signature = 8, length_and_type = 8, checksum = 4;
  std::size_t at = signature;
  while (at + length_and_type + checksum <= bytes.size()) {
    std::uint32_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
    const std::size_t end = at + length_and_type + length + checksum;
    if (end > bytes.size()) return false;
    if (std::memcmp(&bytes[at + 4], "IEND", 4) == 0) return true;
    at = end;
  }
  return false;
}

}  // namespace rainref::image_io
