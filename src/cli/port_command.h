// Runs a port's own program.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/hidden.h"
#include "cli/run_command.h"

namespace rainref::cli {

/// A new empty folder that only this user can access, deleted at the end with its contents. Its path has only safe characters if there is
/// such a folder (plain_path).
class TemporaryRun {
 public:
  TemporaryRun();
  const std::filesystem::path& path() const { return folder_->path(); }

 private:
  std::optional<Hidden> folder_;
};

/// Passes the pack and the output folder to a command.
///
/// {pack} and {out} are replaced by absolute plain paths (plain_path). If the real path has none, a link to it is used.
class PortFolders {
 public:
  PortFolders(const std::filesystem::path& pack, const std::filesystem::path& out);
  /// Returns the command with {pack} and {out} replaced.
  std::string filled_in(const std::string& command) const;
  /// Returns RAINREF_PACK=... and RAINREF_OUT=..., the real absolute paths with any characters.
  std::vector<std::string> environment() const;
  /// Call after the command: Error(port_files) if it replaced the link of {out} by something else.
  void check() const;

 private:
  std::string told(const std::filesystem::path& real, const char* link);

  std::optional<TemporaryRun> links_;
  std::filesystem::path pack_, out_;
  std::string told_pack_, told_out_;
};

}  // namespace rainref::cli
