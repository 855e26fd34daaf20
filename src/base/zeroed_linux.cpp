// Blocks of a mebibyte or more are mapped. Large pages are requested but not required.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "base/zeroed.h"
#include "base/zeroed_shift.h"

namespace rainref::zeroed {
namespace {

constexpr std::size_t mapped_from = std::size_t{1} << 20, large_page = std::size_t{2} << 20;

std::size_t page_bytes() {
  static const auto bytes = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  return bytes;
}
std::size_t whole_pages(std::size_t bytes) { return (bytes + page_bytes() - 1) / page_bytes() * page_bytes(); }

}  // namespace

std::byte* take(std::size_t bytes) {
  if (bytes < mapped_from) {
    void* const memory = std::aligned_alloc(64, (bytes + 63) / 64 * 64);
    return static_cast<std::byte*>(memory ? std::memset(memory, 0, bytes) : nullptr);
  }
  if (bytes > SIZE_MAX / 2) return nullptr;
  // A block that may hold a large page begins with one; the mapped memory before and behind it is returned.
  const std::size_t more = bytes < large_page ? 0 : large_page, shift = next_shift();
  const std::size_t kept = whole_pages(shift + bytes);
  void* const mapped = ::mmap(nullptr, kept + more, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) return nullptr;
  auto* memory = static_cast<std::byte*>(mapped);
  if (more > 0) {
    const std::size_t before = (large_page - reinterpret_cast<std::uintptr_t>(memory) % large_page) % large_page;
    if (before > 0) ::munmap(memory, before);
    if (more > before) ::munmap(memory + before + kept, more - before);
    memory += before;
    ::madvise(memory, kept, MADV_HUGEPAGE);
  }
  return memory + shift;
}
void prefer_large_pages(void* memory, std::size_t bytes) {
  const auto begin = reinterpret_cast<std::uintptr_t>(memory), before = (large_page - begin % large_page) % large_page;
  if (bytes < before + large_page) return;
  ::madvise(static_cast<std::byte*>(memory) + before, (bytes - before) / large_page * large_page, MADV_HUGEPAGE);
}
void give_back(std::byte* memory, std::size_t bytes) {
  if (!memory) return;
  if (bytes < mapped_from) return std::free(memory);
  const std::size_t shift = reinterpret_cast<std::uintptr_t>(memory) % page_bytes();
  ::munmap(memory - shift, whole_pages(shift + bytes));
}

}  // namespace rainref::zeroed
