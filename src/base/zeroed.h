// Zeroed memory of the system. Large blocks are not touched before they are used: the thread that uses a part of one first pays for it,
// and has it near; and where the system has large pages, few of them hold a picture.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace rainref::zeroed {

/// Zeroed, aligned to 64 bytes; nullptr where so much cannot be had. bytes > 0.
std::byte* take(std::size_t bytes);
/// What take gave, of as many bytes.
void give_back(std::byte* memory, std::size_t bytes);

/// Asks for large pages in the whole ones that lie in memory taken elsewhere. A wish: it changes no byte.
void prefer_large_pages(void* memory, std::size_t bytes);

/// Of arrays that are made once and only grow: their new elements are zero and, in a large block, untouched.
template <class T>
struct Allocator {
  using value_type = T;
  Allocator() = default;
  template <class U>
  Allocator(const Allocator<U>&) {}
  T* allocate(std::size_t count) {
    std::byte* const memory = count > static_cast<std::size_t>(-1) / 2 / sizeof(T) ? nullptr : take(count * sizeof(T));
    if (!memory) throw std::bad_alloc();
    return reinterpret_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) { give_back(reinterpret_cast<std::byte*>(memory), count * sizeof(T)); }
  template <class U>
  void construct(U*) {}
  template <class U, class... From>
  void construct(U* at, From&&... from) {
    ::new (static_cast<void*>(at)) U(static_cast<From&&>(from)...);
  }
  bool operator==(const Allocator&) const { return true; }
};
/// Not to be made smaller and larger again: what was there would be seen.
template <class T>
using Array = std::vector<T, Allocator<T>>;

}  // namespace rainref::zeroed
