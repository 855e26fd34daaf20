// By fork and exec of a shell.
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "base/command_end.h"
#include "base/interruption.h"
#include "base/number_text.h"
#include "base/path_text.h"
#include "base/pipes.h"
#include "base/process_control.h"
#include "base/signals.h"
#include "base/system_failure.h"
#include "cli/run_command.h"
#include "cli/shell_word.h"
#include "rainref/error.h"

namespace rainref::cli {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kept_bytes = 65536;

[[noreturn]] void fail(const char* what) { throw Error(ExitCode::io, fmt::format("--exec: {}: {}", what, reason_of(errno))); }

// The child processes of this one. Empty if there is no /proc.
std::set<pid_t> children() {
  std::set<pid_t> found;
  std::error_code error;
  for (fs::directory_iterator i("/proc", error), end; !error && i != end; i.increment(error)) {
    const std::string name = path_text(i->path().filename());
    const std::optional<pid_t> id = whole_from<pid_t>(name);
    if (!id) continue;
    std::ifstream in(i->path() / "stat");
    // If a process has just ended, its file opens but cannot be read: an iterator over its bytes throws, getline does not.
    std::string text;
    std::getline(in, text, '\0');
    // "17 (a name) S 1 ...": the name may contain anything.
    const std::size_t after = text.rfind(") ");
    if (after == std::string::npos || after + 4 > text.size()) continue;
    const std::string_view rest = std::string_view(text).substr(after + 4);
    if (whole_from<pid_t>(rest.substr(0, rest.find(' '))) == ::getpid()) found.insert(*id);
  }
  return found;
}

/// A command's shell and all its descendants. While this exists, a process whose parent ends becomes a child of this one, so that none is
/// lost, also after setsid or as a daemon.
class ProcessTree {
 public:
  ProcessTree() : others_(children()) {
    ::prctl(PR_GET_CHILD_SUBREAPER, &was_reaper_, 0, 0, 0);
    ::prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0);
  }
  ~ProcessTree() {
    if (undo_) end();
    ::prctl(PR_SET_CHILD_SUBREAPER, was_reaper_, 0, 0, 0);
  }
  ProcessTree(const ProcessTree&) = delete;
  ProcessTree& operator=(const ProcessTree&) = delete;

  void began(pid_t shell) {
    shell_ = shell;
    undo_.emplace([this] { kill_all(); });
  }
  bool shell_has_ended() const {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(shell_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == shell_;
  }
  /// Kills the remaining processes. Returns the shell's status.
  int end() {
    const Uninterrupted scope;
    const int status = kill_all();
    undo_.reset();
    return status;
  }

 private:
  std::set<pid_t> rest() const {
    std::set<pid_t> left = children();
    for (const pid_t id : others_) left.erase(id);
    return left;
  }
  // The shell is not reaped until the group is killed, so that no other group can get its number.
  int kill_all() {
    ::kill(-shell_, SIGKILL);
    int status = 0;
    ::waitpid(shell_, &status, 0);
    // A killed process leaves its children to this one. A process of another user, or one that hangs in a driver, remains.
    const Clock::time_point end = Clock::now() + std::chrono::seconds(5);
    for (std::set<pid_t> left = rest(); !left.empty() && Clock::now() < end; left = rest()) {
      for (const pid_t id : left) ::kill(id, SIGKILL);
      for (const pid_t id : left) {
        if (::waitpid(id, nullptr, WNOHANG) == 0) ::poll(nullptr, 0, 1);
      }
    }
    return status;
  }

  std::set<pid_t> others_;
  int was_reaper_ = 0;
  pid_t shell_ = -1;
  std::optional<Undo> undo_;
};

}  // namespace

std::string plain_path(const fs::path& path) {
  std::string text = path_text(path);
  return is_plain(text, "/._-") ? text : "";
}

fs::path temporary_folder() {
  std::error_code error;
  fs::path folder = fs::absolute(fs::temp_directory_path(error), error);
  return error || plain_path(folder).empty() ? fs::path("/tmp") : folder;
}

std::string link_to(const fs::path& folder, const fs::path& link) {
  std::error_code error;
  fs::create_directory_symlink(folder, link, error);
  if (error) throw Error(ExitCode::io, fmt::format("--exec: no link in {}: {}", path_text(link.parent_path()), error.message()));
  return path_text(link);
}

std::string in_command(std::string_view, const std::string& path) { return path; }

std::string shell_word(std::string_view word) { return quoted_word(word, "_-./,:=+@%", '\'', "'\\''"); }

CommandEnd run_command(const std::string& command, std::chrono::duration<double> timeout, const std::vector<std::string>& environment) {
  // Everything that the child needs is made before the fork: with other threads, the child may not allocate.
  std::vector<std::string> variables = environment;
  for (char** v = environ; *v; ++v) {
    const std::string_view name = std::string_view(*v).substr(0, std::string_view(*v).find('='));
    const auto is_same = [&](const std::string& added) { return added.starts_with(name) && added.substr(name.size(), 1) == "="; };
    if (std::none_of(environment.begin(), environment.end(), is_same)) variables.emplace_back(*v);
  }
  std::vector<char*> pointers;
  for (std::string& v : variables) pointers.push_back(v.data());
  pointers.push_back(nullptr);
  int out[2];
  if (make_pipe(out) != 0) fail("no pipe");
  ProcessTree tree;
  {
    const Uninterrupted scope;
    const pid_t child = ::fork();
    if (child < 0) {
      const int error = errno;
      ::close(out[0]);
      ::close(out[1]);
      errno = error;
      fail("no process");
    }
    if (child == 0) {
      ::setpgid(0, 0);
      ::signal(SIGPIPE, SIG_DFL);
      take_signals_again();
      ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
      ::dup2(out[1], STDOUT_FILENO);
      ::dup2(out[1], STDERR_FILENO);
      ::execle("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr), pointers.data());
      ::_exit(127);
    }
    ::setpgid(child, child);  // both processes set it, because either may run first
    tree.began(child);
  }
  ::close(out[1]);

  const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(timeout);
  std::string text;
  const auto read_some = [&](int wait_ms) {
    pollfd waiting{out[0], POLLIN, 0};
    if (::poll(&waiting, 1, wait_ms) <= 0) return false;
    char buffer[4096];
    const ssize_t count = ::read(out[0], buffer, sizeof buffer);
    if (count <= 0) {
      // The output is closed, but the command may still run.
      if (wait_ms > 0) ::poll(nullptr, 0, wait_ms);
      return false;
    }
    text.append(buffer, static_cast<std::size_t>(count));
    if (text.size() > 2 * kept_bytes) text.erase(0, text.size() - kept_bytes);
    return true;
  };
  // The shell's end counts, not the pipe's, because another process may keep the pipe open.
  bool timed_out = false;
  while (!tree.shell_has_ended()) {
    timed_out = Clock::now() >= end;
    if (timed_out) break;
    read_some(20);
  }
  const int status = tree.end();
  for (int i = 0; i < 64 && read_some(0); ++i) {
  }
  ::close(out[0]);
  CommandEnd result{failure_of("the port's command", status), last_lines_of(text)};
  if (timed_out) result.failure = fmt::format("the port's command was ended after {:g} s (--timeout)", timeout.count());
  return result;
}

}  // namespace rainref::cli
