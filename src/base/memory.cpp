#include "base/memory.h"

#include <fmt/format.h>

#include "base/process_memory.h"
#include "rainref/error.h"

namespace rainref {

std::uint64_t resident_memory() { return process_memory().resident; }

void require_memory(std::string_view subject, std::uint64_t bytes) {
  const std::uint64_t need = bytes + resident_memory();
  const MemoryLimit limit = memory_limit();
  if (need > limit.bytes)
    throw Error(ExitCode::usage,
                fmt::format("{} needs {} of memory; {} {}", subject, memory_text(need), limit.owner, memory_text(limit.bytes)));
}

std::string memory_text(std::uint64_t bytes) {
  const double mib = static_cast<double>(bytes) / (1u << 20);
  return mib < 1024 ? fmt::format("{:.1f} MiB", mib) : fmt::format("{:.1f} GiB", mib / 1024);
}

}  // namespace rainref
