// Results in the making, under hidden names; and what killed processes left of theirs.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "base/interruption.h"

namespace rainref {

/// An empty file or folder under a hidden name, `.rainref-` and 16 random hexadecimal digits and `.tmp`, which was free when
/// it was made. At the end, and on an interruption, whatever stands under that name is removed.
///
/// It is locked (flock) while the object lives. A killed process drops its lock, whatever namespace it ran in and however
/// machines number their processes, so remove_leftovers() can tell what is left over from what is being written. Where the
/// file system has no such locks nothing is ever taken for left over.
class Hidden {
 public:
  enum class Kind { file, folder, private_folder };  ///< private: for this user alone
  static std::string random_name() { return random_name(".tmp"); }

  /// Throws std::system_error. Names that are taken are passed over.
  Hidden(
      const std::filesystem::path& parent, Kind kind, const std::function<std::string()>& name = [] { return random_name(); });
  ~Hidden();
  Hidden(const Hidden&) = delete;
  Hidden& operator=(const Hidden&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Of the file, open for writing; or of the folder.
  int descriptor() const { return descriptor_; }
  /// It gets its final name, where a file gives way to a file, and an empty folder to a folder.
  void become(const std::filesystem::path& target);
  /// It gets the name of another folder, which is removed at the end: in one step where the file system can exchange two names
  /// (ext4, XFS, Btrfs and tmpfs can, NFS cannot). Elsewhere a kill may come between two steps; then remove_leftovers() puts the
  /// old folder back.
  void replace(const std::filesystem::path& target);

 private:
  static std::string random_name(std::string_view end);
  bool make(Kind kind);
  void remove() noexcept;

  std::filesystem::path path_;  // as made, to the end: an interruption comes while the owner reads it
  bool is_gone_ = false;        // removed, or under another name; inside an Uninterrupted scope alone
  int descriptor_ = -1;
  std::optional<Undo> undo_;
};

/// Whether a name is one of Hidden's.
bool is_hidden_name(std::string_view name);
/// Removes what killed processes of this user left in a folder, and puts folders back that they were replacing. What cannot
/// be removed stays, silently: it is in nobody's way.
void remove_leftovers(const std::filesystem::path& folder) noexcept;

}  // namespace rainref
