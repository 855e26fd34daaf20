// Where a large block begins in its first page.
#pragma once

#include <atomic>
#include <cstddef>

namespace rainref::zeroed {

/// Offset [byte] of a block in its first page, different from the previous block's. If two blocks begin at the same offset, as rows of the
/// newest and of the previous wave would, Intel's cores mistake a load from one for a read of data just stored to the other, by the last
/// twelve bits of the address, and wait for the store ("4K aliasing").
inline std::size_t next_shift() {
  constexpr std::size_t shift_by = 512, shifts = 8;
  static std::atomic<std::size_t> turn{0};
  return turn.fetch_add(1, std::memory_order_relaxed) % shifts * shift_by;
}

}  // namespace rainref::zeroed
