// Running a port's own program.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace rainref::cli {

/// A shell command with {pack} and {out} replaced by these paths as single words, wherever they stand: bare, in double
/// quotes or in single quotes.
std::string with_folders(const std::string& command, const std::filesystem::path& pack, const std::filesystem::path& out);

/// How a command ended.
struct CommandEnd {
  std::string failure;                  ///< one sentence; "" when it exited with 0
  std::vector<std::string> last_lines;  ///< of what it printed to either stream, at most 20
};

/// Runs a command by /bin/sh, without input, in a process group of its own, and waits for it. Whatever of the group is
/// left when the shell ends, when the time is over, or when rainref itself is interrupted, is killed. Throws Error(io) when
/// no process can be made, and Error(fail) after an interruption.
CommandEnd run_command(const std::string& command, std::chrono::duration<double> timeout);

/// A new empty folder, removed at the end with all that is in it.
class TemporaryRun {
 public:
  TemporaryRun();
  ~TemporaryRun();
  TemporaryRun(const TemporaryRun&) = delete;
  TemporaryRun& operator=(const TemporaryRun&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace rainref::cli
