#include "base/memory.h"

#include <fmt/format.h>
#include <unistd.h>

namespace rainref {

std::size_t physical_memory() {
  return static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

std::string memory_text(std::size_t bytes) {
  const double mib = static_cast<double>(bytes) / (1u << 20);
  return mib < 1024 ? fmt::format("{:.1f} MiB", mib) : fmt::format("{:.1f} GiB", mib / 1024);
}

}  // namespace rainref
