// Unfinished results under hidden names, and the leftovers of killed processes.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "base/interruption.h"

namespace rainref {

/// An empty file or folder under an unused hidden name: `.rainref-`, 16 random hexadecimal digits, `.tmp`. The destructor removes it, as
/// does an interruption.
///
/// It is locked (base/file_lock.h) while the object lives. A killed process loses its lock, in any namespace and on any machine, so
/// remove_leftovers() can tell leftovers from files that are being written. If the file system has no such locks, nothing counts as a
/// leftover.
class Hidden {
 public:
  enum class Kind { file, folder, private_folder };  ///< private: for this user only
  static std::string random_name() { return random_name(".tmp"); }

  /// Throws std::system_error. Skips names that are taken.
  Hidden(
      const std::filesystem::path& parent, Kind kind, const std::function<std::string()>& name = [] { return random_name(); });
  ~Hidden();
  Hidden(const Hidden&) = delete;
  Hidden& operator=(const Hidden&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// For a file, open for writing; or of what the folder's lock stands on.
  int descriptor() const { return descriptor_; }
  /// Renames it to its final name. A file may replace a file; a folder may replace an empty folder.
  void become(const std::filesystem::path& target);
  /// Takes the name of another folder, which is removed at the end. This is one step if the file system can exchange two names (ext4, XFS,
  /// Btrfs and tmpfs can, NFS cannot). Otherwise a kill may come between two steps; then remove_leftovers() restores the old folder.
  void replace(const std::filesystem::path& target);

 private:
  static std::string random_name(std::string_view end);
  bool make(Kind kind);
  void remove() noexcept;

  std::filesystem::path path_;  // never changes, because an interruption may read it at any time
  bool is_gone_ = false;        // removed or renamed; changed only inside an Uninterrupted scope
  int descriptor_ = -1;
  std::optional<Undo> undo_;
};

/// True if a name has the form of Hidden's names.
bool is_hidden_name(std::string_view name);
/// Removes leftovers of this user's killed processes from a folder, and restores folders that they were replacing. Ignores files that
/// cannot be removed, because they do no harm.
void remove_leftovers(const std::filesystem::path& folder) noexcept;

}  // namespace rainref
