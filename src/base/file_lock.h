// Locks that end when a process is killed. On POSIX flock, which belongs to open files, not process numbers, so namespaces do not matter.
#pragma once

#include <filesystem>
#include <optional>

#include "base/interruption.h"

namespace rainref {

enum class FileLock { mine, taken, impossible };  ///< impossible: the file system has no locks
/// Locks an open file or folder, without waiting, until its last descriptor is closed. NFS requires it to be open for writing.
FileLock lock_file(int descriptor);
/// True if a path still leads to the opened file, which may have been removed before it was locked.
bool is_still(int descriptor, const std::filesystem::path& path);

/// Keeps other processes out of a folder by a lock on a hidden file in it, which is removed with the object. The lock of a killed process
/// has no effect.
class FolderLock {
 public:
  /// Throws std::system_error; EWOULDBLOCK: another process has it. If the file system has no locks, nothing is kept out.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  void remove() noexcept;
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::optional<Undo> undo_;
};

}  // namespace rainref
