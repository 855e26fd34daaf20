// Zeroed memory from the system. Large blocks are not touched before use. The thread that first uses a part pays for it and has it near. If
// the system has large pages, a few of them hold a picture.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace rainref::zeroed {

/// Allocates zeroed memory, aligned to 64 bytes; nullptr if there is not enough. bytes > 0.
std::byte* take(std::size_t bytes);
/// Frees memory of take, with the same number of bytes.
void give_back(std::byte* memory, std::size_t bytes);

/// Requests large pages for the whole large pages inside memory allocated elsewhere. Only a hint: it changes no byte.
void prefer_large_pages(void* memory, std::size_t bytes);

/// Allocator for arrays that are made once and only grow: new elements are zero and, in a large block, untouched.
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
/// Do not shrink it and grow it again: the old values would reappear.
template <class T>
using Array = std::vector<T, Allocator<T>>;

}  // namespace rainref::zeroed
