// How much memory a process may take and how much something takes at its peak, so that a scene that cannot fit is refused before it
// is built.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace rainref {

/// The least of all limits on a process's memory, and whose it is.
struct MemoryLimit {
  std::uint64_t bytes;
  std::string owner;  ///< "this machine has", "the cgroup /jobs/7 allows", "the limit RLIMIT_AS (ulimit -v) allows"
};
/// Of: physical memory; memory.max (cgroup v2) and memory.limit_in_bytes (v1) of this process's cgroup and all above it; RLIMIT_AS and
/// RLIMIT_DATA, less what is reserved and not resident. root: where proc and sys/fs/cgroup lie.
MemoryLimit memory_limit(const std::filesystem::path& root = "/");
/// Bytes of this process that lie in memory now.
std::uint64_t resident_memory();

/// Throws Error(usage) when `bytes` more than the process has now pass the limit: "SUBJECT needs 1.5 GiB of memory; this machine has 1.0
/// GiB".
void require_memory(std::string_view subject, std::uint64_t bytes);

/// "1.5 GiB", "12.0 MiB".
std::string memory_text(std::uint64_t bytes);

/// Adds up what is taken, in the order in which it is taken.
class MemoryPeak {
 public:
  /// Taken and kept.
  void hold(std::uint64_t bytes) {
    pass(bytes);
    held_ += bytes;
  }
  /// Taken and given back.
  void pass(std::uint64_t bytes) { peak_ = held_ + bytes > peak_ ? held_ + bytes : peak_; }
  /// Given back, of what was kept.
  void release(std::uint64_t bytes) { held_ -= bytes; }
  /// What another part takes from here on.
  void then(const MemoryPeak& other) {
    pass(other.peak_);
    held_ += other.held_;
  }

  std::uint64_t peak() const { return peak_; }
  std::uint64_t held() const { return held_; }

 private:
  std::uint64_t held_ = 0, peak_ = 0;
};

}  // namespace rainref
