#include "cli/port_command.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "rainref/error.h"

namespace rainref::cli {
namespace {

using Clock = std::chrono::steady_clock;

enum class Quotes { none, in_double, in_single };

std::string quoted(const std::string& text, Quotes quotes) {
  std::string out;
  for (const char c : text) {
    if (quotes == Quotes::in_double) {
      if (c == '"' || c == '\\' || c == '$' || c == '`') out += '\\';
      out += c;
    } else {
      out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
  }
  return quotes == Quotes::none ? "'" + out + "'" : out;
}

volatile sig_atomic_t interrupted = 0;
void note_interruption(int signal) { interrupted = signal; }

/// Notes an interruption instead of dying of it, for a scope.
class InterruptionGuard {
 public:
  InterruptionGuard() {
    interrupted = 0;
    struct sigaction action {};
    action.sa_handler = note_interruption;  // without SA_RESTART: poll() returns
    for (int i = 0; i < count; ++i) ::sigaction(signals[i], &action, &saved_[i]);
  }
  ~InterruptionGuard() {
    for (int i = 0; i < count; ++i) ::sigaction(signals[i], &saved_[i], nullptr);
  }
  InterruptionGuard(const InterruptionGuard&) = delete;
  InterruptionGuard& operator=(const InterruptionGuard&) = delete;

 private:
  static constexpr int count = 3;
  static constexpr int signals[count] = {SIGINT, SIGTERM, SIGHUP};
  struct sigaction saved_[count];
};

constexpr std::size_t kept_bytes = 65536, kept_lines = 20;

std::vector<std::string> last_lines_of(const std::string& text) {
  std::vector<std::string> lines{""};
  for (const char c : text) {
    if (c == '\n') lines.emplace_back();
    else if (c != '\r') lines.back() += c;
  }
  if (lines.back().empty()) lines.pop_back();
  if (lines.size() > kept_lines) lines.erase(lines.begin(), lines.end() - kept_lines);
  return lines;
}

std::string signal_text(int signal) { return fmt::format("signal {} ({})", signal, ::strsignal(signal)); }

std::string failure_of(int status) {
  if (WIFSIGNALED(status)) return fmt::format("the port's command was ended by {}", signal_text(WTERMSIG(status)));
  const int code = WEXITSTATUS(status);
  if (code == 0) return "";
  // A shell reports a child's signal like this.
  if (code > 128 && code <= 128 + 64) return fmt::format("the port's command ended with exit code {}: {}", code, signal_text(code - 128));
  return fmt::format("the port's command ended with exit code {}{}", code, code == 127 ? ": there is no such program" : code == 126 ? ": it is no program" : "");
}

[[noreturn]] void fail(const char* what) { throw Error(ExitCode::io, fmt::format("--exec: {}: {}", what, std::generic_category().message(errno))); }

}  // namespace

std::string with_folders(const std::string& command, const std::filesystem::path& pack, const std::filesystem::path& out) {
  std::string result;
  Quotes quotes = Quotes::none;
  const auto put = [&](std::string_view name, const std::filesystem::path& folder, std::size_t& i) {
    if (command.compare(i, name.size(), name) != 0) return false;
    result += quoted(std::filesystem::absolute(folder).string(), quotes);
    i += name.size() - 1;
    return true;
  };
  for (std::size_t i = 0; i < command.size(); ++i) {
    if (put("{pack}", pack, i) || put("{out}", out, i)) continue;
    const char c = command[i];
    result += c;
    if (c == '\\' && quotes != Quotes::in_single && i + 1 < command.size()) result += command[++i];
    else if (c == '"' && quotes != Quotes::in_single) quotes = quotes == Quotes::none ? Quotes::in_double : Quotes::none;
    else if (c == '\'' && quotes != Quotes::in_double) quotes = quotes == Quotes::none ? Quotes::in_single : Quotes::none;
  }
  return result;
}

CommandEnd run_command(const std::string& command, std::chrono::duration<double> timeout) {
  int out[2];
  if (::pipe2(out, O_CLOEXEC) != 0) fail("no pipe");
  const InterruptionGuard guard;
  const pid_t child = ::fork();
  if (child < 0) fail("no process");
  if (child == 0) {
    ::setpgid(0, 0);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) ::signal(signal, SIG_DFL);
    ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
    ::dup2(out[1], STDOUT_FILENO);
    ::dup2(out[1], STDERR_FILENO);
    ::execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
  }
  ::setpgid(child, child);  // both set it: neither knows who runs first
  ::close(out[1]);

  const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(timeout);
  std::string text;
  const auto read_some = [&](int wait_ms) {
    pollfd waiting{out[0], POLLIN, 0};
    if (::poll(&waiting, 1, wait_ms) <= 0) return false;
    char buffer[4096];
    const ssize_t count = ::read(out[0], buffer, sizeof buffer);
    if (count <= 0) {
      // Nobody prints any more, but the command may go on.
      if (wait_ms > 0) ::poll(nullptr, 0, wait_ms);
      return false;
    }
    text.append(buffer, static_cast<std::size_t>(count));
    if (text.size() > 2 * kept_bytes) text.erase(0, text.size() - kept_bytes);
    return true;
  };
  // The shell's end counts, not the pipe's: a process left behind may hold it. Until the group is killed the shell is not
  // reaped, so that no other group can have its number.
  bool timed_out = false;
  const auto has_ended = [&] {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == child;
  };
  while (!has_ended() && interrupted == 0) {
    timed_out = Clock::now() >= end;
    if (timed_out) break;
    read_some(20);
  }
  ::kill(-child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  for (int i = 0; i < 64 && read_some(0); ++i) {
  }
  ::close(out[0]);
  if (interrupted != 0) throw Error(ExitCode::fail, fmt::format("interrupted by {} while the port's command ran", signal_text(interrupted)));
  CommandEnd result{failure_of(status), last_lines_of(text)};
  if (timed_out) result.failure = fmt::format("the port's command was ended after {:g} s (--timeout)", timeout.count());
  return result;
}

TemporaryRun::TemporaryRun() {
  std::error_code error;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  std::string name = (error ? std::filesystem::path("/tmp") : parent) / "rainref-port-XXXXXX";
  if (!::mkdtemp(name.data())) fail("no temporary folder");
  path_ = name;
}
TemporaryRun::~TemporaryRun() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace rainref::cli
