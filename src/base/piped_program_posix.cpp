#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/command_end.h"
#include "base/interruption.h"
#include "base/path_text.h"
#include "base/piped_program.h"
#include "base/pipes.h"
#include "base/process_control.h"
#include "base/signals.h"
#include "base/system_failure.h"

namespace rainref {
namespace {

[[noreturn]] void fail(const char* what, int error) { throw std::runtime_error(fmt::format("{}: {}", what, reason_of(error))); }

/// While it exists, writing to a closed pipe is an error of write() and does not end this process.
class NoBrokenPipe {
 public:
  NoBrokenPipe() {
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;
    ::sigaction(SIGPIPE, &ignore, &before_);
  }
  ~NoBrokenPipe() { ::sigaction(SIGPIPE, &before_, nullptr); }
  NoBrokenPipe(const NoBrokenPipe&) = delete;
  NoBrokenPipe& operator=(const NoBrokenPipe&) = delete;

 private:
  struct sigaction before_ {};
};

}  // namespace

class PipedProgram::Process {
 public:
  Process() : messages_(std::tmpfile(), &std::fclose) {
    if (!messages_) fail("no temporary file", errno);
  }
  ~Process() {
    if (id_ > 0) kill();
    close_pipe();
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  // Everything that the child needs is made before the fork: with other threads, the child may not allocate.
  void start(std::string program, std::vector<std::string> arguments, Pipe pipe) {
    const bool reads = pipe == Pipe::to_input;
    arguments.insert(arguments.begin(), program);
    std::vector<char*> argv;
    for (std::string& word : arguments) argv.push_back(word.data());
    argv.push_back(nullptr);
    int ends[2];
    if (make_pipe(ends) != 0) fail("no pipe", errno);
    const int messages = ::fileno(messages_.get()), nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    const pid_t parent = ::getpid();
    const Uninterrupted scope;
    id_ = ::fork();
    const int why = errno;
    if (id_ == 0) {
      ::setpgid(0, 0);  // signals are for this program, which then ends the child and its children
      ::signal(SIGPIPE, SIG_DFL);
      take_signals_again();
      // A program that writes ends by itself when nobody reads. It must not end with the thread that started it.
      if (reads) ::prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0);
      if (::getppid() != parent) ::_exit(127);  // the parent ended before
      ::dup2(reads ? ends[0] : nothing, STDIN_FILENO);
      ::dup2(reads ? messages : ends[1], STDOUT_FILENO);
      ::dup2(messages, STDERR_FILENO);
      ::execv(program.c_str(), argv.data());
      ::_exit(127);
    }
    if (nothing >= 0) ::close(nothing);
    ::close(ends[reads ? 0 : 1]);
    pipe_ = ends[reads ? 1 : 0];
    if (id_ < 0) fail("no process can be made", why);
    ::setpgid(id_, id_);  // both processes set it, because either may run first
    undo_.emplace([id = id_] {
      ::kill(-id, SIGKILL);
      ::waitpid(id, nullptr, 0);
    });
  }

  bool write(std::span<const std::byte> bytes) {
    const NoBrokenPipe scope;
    while (!bytes.empty()) {
      const ssize_t count = ::write(pipe_, bytes.data(), bytes.size());
      if (count >= 0)
        bytes = bytes.subspan(static_cast<std::size_t>(count));
      else if (errno == EPIPE)
        return false;
      else if (errno != EINTR)
        throw_system_error(errno);
    }
    return true;
  }
  std::size_t read(std::span<std::byte> bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t count = ::read(pipe_, bytes.data() + done, bytes.size() - done);
      if (count == 0) break;
      if (count > 0)
        done += static_cast<std::size_t>(count);
      else if (errno != EINTR)
        throw_system_error(errno);
    }
    return done;
  }
  /// Returns the status of waitpid.
  int end() {
    close_pipe();
    return wait();
  }
  std::string printed() {
    std::string text;
    std::rewind(messages_.get());
    for (int c; (c = std::fgetc(messages_.get())) != EOF && text.size() < (1u << 20);) text += static_cast<char>(c);
    return text;
  }

 private:
  void close_pipe() {
    if (pipe_ >= 0) ::close(std::exchange(pipe_, -1));
  }
  int wait() {
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    const Uninterrupted scope;
    undo_.reset();
    id_ = -1;
    return status;
  }
  void kill() {
    ::kill(-id_, SIGKILL);
    wait();
  }

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> messages_;
  pid_t id_ = -1;
  int pipe_ = -1;
  std::optional<Undo> undo_;
};

PipedProgram::PipedProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments, Pipe pipe)
    : process_(std::make_unique<Process>()) {
  process_->start(path_text(program), arguments, pipe);
}
PipedProgram::~PipedProgram() = default;
bool PipedProgram::write(std::span<const std::byte> bytes) { return process_->write(bytes); }
std::size_t PipedProgram::read(std::span<std::byte> bytes) { return process_->read(bytes); }
CommandEnd PipedProgram::end(const std::string& name) {
  std::string failure = failure_of(name, process_->end());
  return {std::move(failure), last_lines_of(process_->printed())};
}

}  // namespace rainref
