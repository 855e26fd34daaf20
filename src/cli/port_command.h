// Runs a port's own program.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/hidden.h"

namespace rainref::cli {

/// A new empty folder that only this user can access, deleted at the end with its contents. Its path has only safe characters (see
/// PortFolders).
class TemporaryRun {
 public:
  TemporaryRun();
  const std::filesystem::path& path() const { return folder_->path(); }

 private:
  std::optional<Hidden> folder_;
};

/// Passes the pack and the output folder to a command.
///
/// {pack} and {out} are replaced by absolute paths with only letters, digits and `/._-`, so that no shell splits or interprets them,
/// however nested or quoted. If the real path has other characters, a link to it is used.
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
  std::filesystem::path told(const std::filesystem::path& real, const char* link);

  std::optional<TemporaryRun> links_;
  std::filesystem::path pack_, out_, told_pack_, told_out_;
};

/// How a command ended.
struct CommandEnd {
  std::string failure;                  ///< one sentence; "" if the exit code was 0
  std::vector<std::string> last_lines;  ///< of its standard output and standard error, at most 20
};

/// Runs a command with /bin/sh, without input, with these environment variables added, and waits. All its descendants are killed, also
/// those that started a session or changed their parent: when the shell ends, when the time is over, and when rainref is interrupted.
/// Throws Error(io) if no process can be started.
CommandEnd run_command(const std::string& command, std::chrono::duration<double> timeout, const std::vector<std::string>& environment = {});

}  // namespace rainref::cli
