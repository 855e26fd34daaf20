// Counts the memory that the allocator has given out. The process is a browser or node, so its memory and page size do not belong to this
// program.
#include <malloc.h>

#include "base/process_memory.h"

namespace rainref {

ProcessMemory process_memory() {
  const auto used = static_cast<std::uint64_t>(mallinfo().uordblks);
  return {used, used, used};
}

}  // namespace rainref
