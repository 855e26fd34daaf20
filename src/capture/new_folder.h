// Folders that appear under their final name only when whole.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace rainref::capture {

/// A folder being written, under a hidden name beside its final one. commit() gives it its name. Without a commit it
/// is removed with all that is in it, and so are the parents that were made for it.
///
/// The final name is free, an empty folder, or a folder that commit() may replace: `may_replace` says why not, or "".
/// Every failure is Error(io). A process that is killed leaves the hidden folder behind, never half a final one.
class NewFolder {
 public:
  using MayReplace = std::function<std::string(const std::filesystem::path&)>;
  NewFolder(std::filesystem::path target, const MayReplace& may_replace);
  ~NewFolder();
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  /// Writes a new file, its folders included. The path is relative, with slashes.
  void write(const std::string& path, std::span<const std::byte> bytes);
  /// Call once, last.
  void commit();

 private:
  std::filesystem::path target_, hidden_;
  std::vector<std::filesystem::path> made_;  // parents, innermost first

  std::filesystem::path hidden_name() const;
};

}  // namespace rainref::capture
