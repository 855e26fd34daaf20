// Memory used by this process.
#pragma once

#include <cstdint>

namespace rainref {

/// In bytes; 0 if the system does not tell.
struct ProcessMemory {
  std::uint64_t size = 0;      ///< address space
  std::uint64_t resident = 0;  ///< resident
  std::uint64_t data = 0;      ///< writable
};
ProcessMemory process_memory();

}  // namespace rainref
