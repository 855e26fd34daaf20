// Limits of the machine, and of the job that this process is in, as containers are.
#include <windows.h>

#include "base/memory.h"

namespace rainref {

MemoryLimit memory_limit(const std::filesystem::path&) {
  MEMORYSTATUSEX machine{};
  machine.dwLength = sizeof machine;
  ::GlobalMemoryStatusEx(&machine);
  MemoryLimit least{machine.ullTotalPhys, "this machine has"};
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION job{};
  if (!::QueryInformationJobObject(nullptr, JobObjectExtendedLimitInformation, &job, sizeof job, nullptr)) return least;
  const auto lower = [&](DWORD flag, std::uint64_t bytes) {
    if ((job.BasicLimitInformation.LimitFlags & flag) && bytes < least.bytes) least = {bytes, "the job of this process allows"};
  };
  lower(JOB_OBJECT_LIMIT_PROCESS_MEMORY, job.ProcessMemoryLimit);
  lower(JOB_OBJECT_LIMIT_JOB_MEMORY, job.JobMemoryLimit);
  return least;
}

}  // namespace rainref
