// Large arrays of the whole program in large pages where the system has them: the first touch of a page is a fault, and a large page is
// one for 512 small ones. The program alone; a library leaves this to its caller.
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
// As the standard library's does. A sanitizer brings its own one, which does not call the one above.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  try {
    return operator new(bytes);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
