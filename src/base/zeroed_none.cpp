// For systems where memory comes only from the C library.
#include <cstdlib>
#include <cstring>

#include "base/zeroed.h"

namespace rainref::zeroed {

std::byte* take(std::size_t bytes) {
  void* const memory = std::aligned_alloc(64, (bytes + 63) / 64 * 64);
  return static_cast<std::byte*>(memory ? std::memset(memory, 0, bytes) : nullptr);
}
void prefer_large_pages(void*, std::size_t) {}
void give_back(std::byte* memory, std::size_t) { std::free(memory); }

}  // namespace rainref::zeroed
