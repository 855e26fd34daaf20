// Folders that are made on the way to a result, and links that lead to one.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "base/interruption.h"

namespace rainref {

/// Where a path leads: its last component's symbolic links are followed, also when they end at nothing, so that what is
/// then made there is what the link names. A slash at the end is dropped. Throws std::system_error for a circle of links.
std::filesystem::path followed(std::filesystem::path path);

/// Makes a folder and those above it. Unless keep() is called, those that it made go again, if nothing lies in them; on
/// an interruption too. Throws std::system_error.
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

/// Waits until a folder's entries are on the disk, or a file's bytes. Throws std::system_error, but not where the file
/// system cannot say (EINVAL).
void sync_to_disk(const std::filesystem::path& path);
/// The same of all of them at once: a disk makes one wait of many. Throws the first one's error once all have ended.
void sync_to_disk(std::span<const std::filesystem::path> paths);

}  // namespace rainref
