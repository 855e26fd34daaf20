// Limits of the machine, of Linux's control groups and of the process.
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <optional>

#include <fmt/format.h>

#include "base/memory.h"
#include "base/number_text.h"
#include "base/process_memory.h"

namespace rainref {
namespace {

/// The number in a file's first line; none if there is no such file, or for a word like "max".
std::optional<std::uint64_t> number_in(const std::filesystem::path& file) {
  std::string text;
  std::getline(std::ifstream(file), text);
  return whole_from<std::uint64_t>(text);
}

void lower(MemoryLimit& least, std::uint64_t bytes, const std::string& owner) {
  if (bytes < least.bytes) least = {bytes, owner};
}

/// A limit holds for a cgroup and all below it. A container may show a group's path as it is outside; then only the mount's root is found.
void lower_by_group(MemoryLimit& least, const std::filesystem::path& mount, std::string group, const char* file) {
  while (true) {
    while (group.ends_with('/')) group.pop_back();
    if (const auto bytes = number_in(mount / group.substr(group.empty() ? 0 : 1) / file))
      lower(least, *bytes, fmt::format("the cgroup {} allows", group.empty() ? "/" : group));
    if (group.empty()) return;
    group.resize(group.rfind('/') == std::string::npos ? 0 : group.rfind('/'));
  }
}

/// Lines "4:memory,cpu:/group" (v1) and "0::/group" (v2).
void lower_by_groups(MemoryLimit& least, const std::filesystem::path& root) {
  std::ifstream groups(root / "proc/self/cgroup");
  const std::filesystem::path mounts = root / "sys/fs/cgroup";
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",", group = line.substr(second + 1);
    if (!group.starts_with('/')) continue;
    if (controllers == ",,") {
      for (const auto& mount : {mounts, mounts / "unified"}) lower_by_group(least, mount, group, "memory.max");
    } else if (controllers.find(",memory,") != std::string::npos) {
      lower_by_group(least, mounts / "memory", group, "memory.limit_in_bytes");
    }
  }
}

}  // namespace

MemoryLimit memory_limit(const std::filesystem::path& root) {
  MemoryLimit least{static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)),
                    "this machine has"};
  lower_by_groups(least, root);
  const ProcessMemory p = process_memory();
  const auto lower_by_resource = [&](auto resource, std::uint64_t taken, const char* owner) {
    rlimit limit{};
    if (::getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
    const std::uint64_t reserved = taken > p.resident ? taken - p.resident : 0;
    lower(least, limit.rlim_cur > reserved ? limit.rlim_cur - reserved : 0, owner);
  };
  lower_by_resource(RLIMIT_AS, p.size, "the limit RLIMIT_AS (ulimit -v) allows");
  lower_by_resource(RLIMIT_DATA, p.data, "the limit RLIMIT_DATA (ulimit -d) allows");
  return least;
}

}  // namespace rainref
