// What the allocator has given out: the process is a browser or node, whose memory, and pages of another size, are not this program's.
#include <malloc.h>

#include "base/process_memory.h"

namespace rainref {

ProcessMemory process_memory() {
  const auto used = static_cast<std::uint64_t>(mallinfo().uordblks);
  return {used, used, used};
}

}  // namespace rainref
