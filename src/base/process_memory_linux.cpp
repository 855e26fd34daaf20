// From a file of the kernel.
#include <fstream>

#include <unistd.h>

#include "base/process_memory.h"

namespace rainref {

ProcessMemory process_memory() {
  std::uint64_t size = 0, resident = 0, skipped = 0, data = 0;
  std::ifstream("/proc/self/statm") >> size >> resident >> skipped >> skipped >> skipped >> data;
  const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return {size * page, resident * page, data * page};
}

}  // namespace rainref
