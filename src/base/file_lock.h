// Locks that a killed process drops: flock, which knows open files and not process numbers, so that namespaces do not matter.
#pragma once

#include <filesystem>
#include <optional>

#include "base/interruption.h"

namespace rainref {

enum class FileLock { mine, taken, impossible };  ///< impossible: the file system has no locks
/// Locks an open file or folder, without waiting, until its last descriptor is closed. NFS wants it open for writing.
FileLock lock_file(int descriptor);
/// Whether a name still leads to what was opened: before it was locked it may have been removed.
bool is_still(int descriptor, const std::filesystem::path& path);

/// Keeps other processes out of a folder: a lock on a hidden file there, which goes with the object. That of a killed
/// process keeps nobody out.
class FolderLock {
 public:
  /// Throws std::system_error; EWOULDBLOCK: another one has it. Where the file system has no locks nobody is kept out.
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
