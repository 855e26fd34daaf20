// Blocks of a mebibyte or more are pages of the system, which are zero and are not touched before use. Large pages need a right that users
// do not have.
#include <windows.h>

#include <malloc.h>

#include <cstring>

#include "base/zeroed.h"

namespace rainref::zeroed {
namespace {

constexpr std::size_t paged_from = std::size_t{1} << 20;

}  // namespace

std::byte* take(std::size_t bytes) {
  if (bytes >= paged_from) return static_cast<std::byte*>(::VirtualAlloc(nullptr, bytes, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE));
  void* const memory = ::_aligned_malloc(bytes, 64);
  return static_cast<std::byte*>(memory ? std::memset(memory, 0, bytes) : nullptr);
}
void prefer_large_pages(void*, std::size_t) {}
void give_back(std::byte* memory, std::size_t bytes) {
  if (!memory) return;
  if (bytes >= paged_from)
    ::VirtualFree(memory, 0, MEM_RELEASE);
  else
    ::_aligned_free(memory);
}

}  // namespace rainref::zeroed
