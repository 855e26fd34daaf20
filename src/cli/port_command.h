// Running a port's own program.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/hidden.h"

namespace rainref::cli {

/// A new empty folder for this user alone, removed at the end with all that is in it. Its path is plain (see PortFolders).
class TemporaryRun {
 public:
  TemporaryRun();
  const std::filesystem::path& path() const { return folder_->path(); }

 private:
  std::optional<Hidden> folder_;
};

/// How a command is told its pack and the folder for its outputs.
///
/// What stands for {pack} and {out} is an absolute path of letters, digits and `/._-` alone. No shell, however deeply it is
/// nested or quoted, takes such a word apart. Where the real path has other characters it is that of a link to it.
class PortFolders {
 public:
  PortFolders(const std::filesystem::path& pack, const std::filesystem::path& out);
  /// The command with {pack} and {out} replaced.
  std::string filled_in(const std::string& command) const;
  /// RAINREF_PACK=... and RAINREF_OUT=..., the real absolute paths, whatever their characters.
  std::vector<std::string> environment() const;
  /// After the command: Error(port_files) when it put something of its own in the place of the link that was {out}.
  void check() const;

 private:
  std::filesystem::path told(const std::filesystem::path& real, const char* link);

  std::optional<TemporaryRun> links_;
  std::filesystem::path pack_, out_, told_pack_, told_out_;
};

/// How a command ended.
struct CommandEnd {
  std::string failure;                  ///< one sentence; "" when it exited with 0
  std::vector<std::string> last_lines;  ///< of what it printed to either stream, at most 20
};

/// Runs a command by /bin/sh, without input, with these variables added to the environment, and waits for it. Whatever it
/// started and left running is killed, with all that came of it, also what made itself a session or a parent of its own: when
/// the shell ends, when the time is over, and when rainref is interrupted. Throws Error(io) when no process can be made.
CommandEnd run_command(const std::string& command, std::chrono::duration<double> timeout, const std::vector<std::string>& environment = {});

}  // namespace rainref::cli
