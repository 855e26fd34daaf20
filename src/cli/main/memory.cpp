// Allocates large arrays of the program in large pages if the system has them: the first access to a page is a fault, and one large page
// replaces 512 small ones. For the program only; a library leaves this to its caller.
#include <cstdlib>
#include <new>

#include "base/zeroed.h"

void* operator new(std::size_t bytes) {
  for (;;) {
    if (void* const memory = std::malloc(bytes > 0 ? bytes : 1)) {
      rainref::zeroed::prefer_large_pages(memory, bytes);
      return memory;
    }
    const std::new_handler handler = std::get_new_handler();
    if (!handler) throw std::bad_alloc();
    handler();
  }
}
// As in the standard library. A sanitizer has its own, which does not call the one above.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  try {
    return operator new(bytes);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
