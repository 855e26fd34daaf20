// What this process has taken.
#pragma once

#include <cstdint>

namespace rainref {

/// In bytes; 0 where the system does not say.
struct ProcessMemory {
  std::uint64_t size = 0;      ///< of its address space
  std::uint64_t resident = 0;  ///< in memory
  std::uint64_t data = 0;      ///< writable
};
ProcessMemory process_memory();

}  // namespace rainref
