// Folders made for a result, and links that lead to one.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "base/interruption.h"

namespace rainref {

/// Target of a path. Symbolic links of its last component are followed, even if the target does not exist, so that the target is created
/// and not the link. A slash at the end is dropped. Throws std::system_error for a circle of links.
std::filesystem::path followed(std::filesystem::path path);

/// Makes a folder and its parents. Unless keep() is called, those that it made are removed again if they are empty, also on an
/// interruption. Throws std::system_error.
class MadeFolders {
 public:
  /// "" is the current folder.
  explicit MadeFolders(const std::filesystem::path& folder);
  ~MadeFolders();
  MadeFolders(const MadeFolders&) = delete;
  MadeFolders& operator=(const MadeFolders&) = delete;
  void keep();
  /// Innermost first.
  const std::vector<std::filesystem::path>& made() const { return made_; }

 private:
  void remove() noexcept;
  std::vector<std::filesystem::path> made_;
  std::optional<Undo> undo_;
};

/// Waits until a folder's entries, or a file's bytes, are on the disk. Throws std::system_error, except if the file system does not support
/// this (EINVAL).
void sync_to_disk(const std::filesystem::path& path);
/// The same for several paths at once, because a disk combines the waits. Throws the first path's error after all have ended.
void sync_to_disk(std::span<const std::filesystem::path> paths);

}  // namespace rainref
