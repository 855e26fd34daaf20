// Folders that appear under their final name only when whole.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "base/folders.h"
#include "base/hidden.h"

namespace rainref::capture {

/// A folder being written, under a hidden name beside its final one (base/hidden.h). commit() gives it its name. Without a
/// commit it is removed with all that is in it, and so are the parents that were made for it.
///
/// The final name is free, an empty folder, or a folder that commit() may replace: `may_replace` says why not, or "". A
/// symbolic link stays, and what it names is written. Every failure is Error(io).
///
/// A process that is killed leaves the old folder or the new one under the final name, never half of one. All that it wrote is
/// on the disk before it has that name. Its hidden folder is removed when the next one is made there.
class NewFolder {
 public:
  using MayReplace = std::function<std::string(const std::filesystem::path&)>;
  NewFolder(std::filesystem::path target, MayReplace may_replace);
  ~NewFolder();
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  /// Writes a new file, its folders included. The path is relative, with slashes.
  void write(const std::string& path, std::span<const std::byte> bytes);
  /// Call once, last.
  void commit();

 private:
  bool has_older() const;

  std::filesystem::path shown_, target_;  // as the caller named it, and with its links followed
  MayReplace may_replace_;
  std::optional<MadeFolders> parents_;
  std::optional<Hidden> hidden_;
  std::set<std::filesystem::path> folders_;  // that files lie in, hidden_ included
};

}  // namespace rainref::capture
