// Blocks of a mebibyte or more are mapped; large pages are asked for, and it does not matter whether they come.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "base/zeroed.h"

namespace rainref::zeroed {
namespace {

constexpr std::size_t mapped_from = std::size_t{1} << 20, large_page = std::size_t{2} << 20;

}  // namespace

std::byte* take(std::size_t bytes) {
  if (bytes < mapped_from) {
    void* const memory = std::aligned_alloc(64, (bytes + 63) / 64 * 64);
    return static_cast<std::byte*>(memory ? std::memset(memory, 0, bytes) : nullptr);
  }
  if (bytes > SIZE_MAX / 2) return nullptr;
  // One that may hold a large page begins with one: what was mapped before and behind it goes back.
  const std::size_t page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)), more = bytes < large_page ? 0 : large_page;
  const std::size_t kept = (bytes + page - 1) / page * page;
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
  return memory;
}
void give_back(std::byte* memory, std::size_t bytes) {
  if (!memory) return;
  if (bytes < mapped_from)
    std::free(memory);
  else
    ::munmap(memory, bytes);
}

}  // namespace rainref::zeroed
