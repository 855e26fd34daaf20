// Written from Apple's documents and never compiled.
#include <mach/mach.h>

#include "base/process_memory.h"

namespace rainref {

ProcessMemory process_memory() {
  mach_task_basic_info info{};
  mach_msg_type_number_t count = MACH_TASK_BASIC_INFO_COUNT;
  if (::task_info(::mach_task_self(), MACH_TASK_BASIC_INFO, reinterpret_cast<task_info_t>(&info), &count) != KERN_SUCCESS) return {};
  return {info.virtual_size, info.resident_size, info.resident_size};
}

}  // namespace rainref
