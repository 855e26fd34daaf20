// Memory limits of a process and peak memory needs, to refuse a scene that cannot fit before it is built.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace rainref {

/// The smallest limit on a process's memory, and its source.
struct MemoryLimit {
  std::uint64_t bytes;
  std::string owner;  ///< "this machine has", "the cgroup /jobs/7 allows", "the limit RLIMIT_AS (ulimit -v) allows"
};
/// Minimum of: physical memory; memory.max (cgroup v2) and memory.limit_in_bytes (v1) of this process's cgroup and its parents; RLIMIT_AS
/// and RLIMIT_DATA, less reserved memory that is not resident. root: folder of proc and sys/fs/cgroup.
MemoryLimit memory_limit(const std::filesystem::path& root = "/");
/// Resident memory of this process [byte].
std::uint64_t resident_memory();

/// Throws Error(usage) if `bytes` in addition to the current use exceed the limit: "SUBJECT needs 1.5 GiB of memory; this machine has 1.0
/// GiB".
void require_memory(std::string_view subject, std::uint64_t bytes);

/// "1.5 GiB", "12.0 MiB".
std::string memory_text(std::uint64_t bytes);

/// Adds up memory in the order in which it is taken.
class MemoryPeak {
 public:
  /// Memory taken and kept.
  void hold(std::uint64_t bytes) {
    pass(bytes);
    held_ += bytes;
  }
  /// Memory taken and given back.
  void pass(std::uint64_t bytes) { peak_ = held_ + bytes > peak_ ? held_ + bytes : peak_; }
  /// Gives back memory that was kept.
  void release(std::uint64_t bytes) { held_ -= bytes; }
  /// Adds the use of another part from here on.
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
