// Folders that appear under their final name only when whole.
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
  /// Where it lies until then, for files that others write, and bring to the disk, there.
  const std::filesystem::path& path() const { return hidden_->path(); }
  /// Call once, last.
  void commit();
  /// The same where the final name is free still; otherwise what has come to lie there stays, this folder goes, and false is returned. Of
  /// any number that race for a name one gets it. All that it holds is on the disk then; its name is once folders_of_names() are
  /// (sync_to_disk), for which who makes many folders need not wait each time: `also` are those of earlier ones, for which it waits
  /// together with its own files.
  bool commit_if_first(const std::vector<std::filesystem::path>& also = {});
  /// The folders that hold its name and those of the parents that were made for it. Before the commit.
  std::vector<std::filesystem::path> folders_of_names() const;

 private:
  void sync_contents() const;
  bool has_older() const;

  std::filesystem::path shown_, target_;  // as the caller named it, and with its links followed
  MayReplace may_replace_;
  std::optional<MadeFolders> parents_;
  std::optional<Hidden> hidden_;
  std::vector<std::filesystem::path> files_;  // that write() wrote
  std::set<std::filesystem::path> folders_;   // that files lie in, hidden_ included
};

}  // namespace rainref::capture
