#include <windows.h>

#include <psapi.h>

#include "base/process_memory.h"

namespace rainref {

ProcessMemory process_memory() {
  PROCESS_MEMORY_COUNTERS counters{};
  if (!::K32GetProcessMemoryInfo(::GetCurrentProcess(), &counters, sizeof counters)) return {};
  return {counters.PagefileUsage, counters.WorkingSetSize, counters.PagefileUsage};
}

}  // namespace rainref
