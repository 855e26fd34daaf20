// Blocks of a mebibyte or more are pages of the system, which are zero and are not touched before use. Large pages need a right that users
// do not have.
#include <windows.h>

#include <malloc.h>

#include <cstdint>
#include <cstring>

#include "base/zeroed.h"
#include "base/zeroed_shift.h"

namespace rainref::zeroed {
namespace {

constexpr std::size_t paged_from = std::size_t{1} << 20;
constexpr std::uintptr_t reserved = std::uintptr_t{1} << 16;  // the system's blocks begin at its multiples

}  // namespace

std::byte* take(std::size_t bytes) {
  if (bytes > SIZE_MAX / 2) return nullptr;
  if (bytes >= paged_from) {
    const std::size_t shift = next_shift();
    void* const block = ::VirtualAlloc(nullptr, shift + bytes, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE);
    return block ? static_cast<std::byte*>(block) + shift : nullptr;
  }
  void* const memory = ::_aligned_malloc(bytes, 64);
  return static_cast<std::byte*>(memory ? std::memset(memory, 0, bytes) : nullptr);
}
void prefer_large_pages(void*, std::size_t) {}
void give_back(std::byte* memory, std::size_t bytes) {
  if (!memory) return;
  if (bytes >= paged_from)
    ::VirtualFree(memory - reinterpret_cast<std::uintptr_t>(memory) % reserved, 0, MEM_RELEASE);
  else
    ::_aligned_free(memory);
}

}  // namespace rainref::zeroed
