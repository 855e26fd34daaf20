// Folders that get their final name only when they are complete.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/folders.h"
#include "base/hidden.h"

namespace rainref::capture {

/// A folder that is written under a hidden name beside its final one (base/hidden.h). commit() renames it. Without a commit, it is removed
/// with its contents and with the parents that were created for it.
///
/// The final name may be free, an empty folder, or a folder that commit() may replace: `may_replace` returns the reason if not, or "". A
/// symbolic link stays, and its target is replaced. Every failure is Error(io).
///
/// If a process is killed, the final name has the complete old folder or the complete new one. All files are on disk before the folder is
/// renamed. A hidden folder that remains is removed when the next one is made there.
class NewFolder {
 public:
  using MayReplace = std::function<std::string(const std::filesystem::path&)>;
  NewFolder(std::filesystem::path target, MayReplace may_replace);
  ~NewFolder();
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  /// Writes a new file and creates its folders. The path is relative, with slashes.
  void write(const std::string& path, std::span<const std::byte> bytes);
  /// Path of the hidden folder, for files that the caller writes and syncs to disk.
  const std::filesystem::path& path() const { return hidden_->path(); }
  /// Call once, as the last call.
  void commit();
  /// Like commit() if the final name is still free. Otherwise keeps the existing folder, removes this one and returns false. If several
  /// processes compete for a name, one gets it. The contents are then on disk; the name is on disk only after sync_to_disk of
  /// folders_of_names(). A caller that makes many folders can defer that: `also` are the folders of names of earlier ones, which are synced
  /// together with this one's files.
  bool commit_if_first(const std::vector<std::filesystem::path>& also = {});
  /// The folders that contain its name and those of the parents that were created for it. Call before the commit.
  std::vector<std::filesystem::path> folders_of_names() const;

 private:
  void sync_contents() const;
  bool has_older() const;

  std::filesystem::path shown_, target_;  // as the caller named it, and with links resolved
  MayReplace may_replace_;
  std::optional<MadeFolders> parents_;
  std::optional<Hidden> hidden_;
  std::vector<std::filesystem::path> files_;  // written by write()
  std::set<std::filesystem::path> folders_;   // that contain files, hidden_ included
};

}  // namespace rainref::capture
