#include "cli/film.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <optional>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/folders.h"
#include "base/hidden.h"
#include "base/interruption.h"
#include "base/program_path.h"
#include "base/signals.h"
#include "cli/command_end.h"
#include "cli/film_command.h"
#include "cli/process_control.h"
#include "rainref/error.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_film(const fs::path& film, const std::string& why) {
  throw Error(ExitCode::io, fmt::format("--film '{}': {}", film.string(), why));
}
std::string reason_of(int error) { return std::generic_category().message(error); }

fs::path found_ffmpeg(const fs::path& film) {
  fs::path program = program_in_path("ffmpeg");
  if (program.empty()) refuse_film(film, "ffmpeg, which makes films, is in no folder of PATH (Debian: apt-get install ffmpeg)");
  return program;
}

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

void require_film(const fs::path& path, FilmRate rate) {
  film_arguments(path, 1, 1, rate, path);
  std::error_code none;
  if (const auto what = fs::status(path, none).type(); what != fs::file_type::not_found && what != fs::file_type::regular)
    refuse_film(path, what == fs::file_type::directory ? "a folder has that name" : "what has that name is no file");
  found_ffmpeg(path);
}

/// The ffmpeg process, its input and its messages.
class Film::Process {
 public:
  Process(const fs::path& film, int width, int height, FilmRate rate) : film_(film), messages_(std::tmpfile(), &std::fclose) {
    require_film(film, rate);
    if (!messages_) refuse_film(film, fmt::format("no temporary file: {}", reason_of(errno)));
    try {
      target_ = followed(film);
      folders_.emplace(target_.parent_path());
      const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
      remove_leftovers(folder);
      written_.emplace(folder, Hidden::Kind::file);
    } catch (const std::system_error& e) {
      refuse_film(film, fmt::format("cannot write there: {}", e.code().message()));
    }
    start(found_ffmpeg(film).string(), film_arguments(film, width, height, rate, written_->path()));
  }
  ~Process() {
    if (id_ > 0) kill();
    close_pipe();
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void write(std::span<const std::byte> bytes) {
    const NoBrokenPipe scope;
    while (!bytes.empty()) {
      const ssize_t count = ::write(pipe_, bytes.data(), bytes.size());
      if (count >= 0) {
        bytes = bytes.subspan(static_cast<std::size_t>(count));
      } else if (errno == EPIPE) {
        end(true);
      } else if (errno != EINTR) {
        refuse_film(film_, fmt::format("no picture can be given to ffmpeg: {}", reason_of(errno)));
      }
    }
  }
  void finish() {
    end(false);
    try {
      sync_to_disk(written_->path());
      written_->become(target_);
    } catch (const std::system_error& e) {
      refuse_film(film_, fmt::format("cannot be written: {}", e.code().message()));
    }
    folders_->keep();
  }

 private:
  // Everything that the child needs is made before the fork: with other threads, the child may not allocate.
  void start(std::string program, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), program);
    std::vector<char*> argv;
    for (std::string& word : arguments) argv.push_back(word.data());
    argv.push_back(nullptr);
    int ends[2];
    if (::pipe(ends) != 0) refuse_film(film_, fmt::format("no pipe: {}", reason_of(errno)));
    for (const int end : ends) ::fcntl(end, F_SETFD, FD_CLOEXEC);
    const int messages = ::fileno(messages_.get());
    const pid_t parent = ::getpid();
    const Uninterrupted scope;
    id_ = ::fork();
    const int why = errno;
    if (id_ == 0) {
      ::setpgid(0, 0);  // signals are for this program, which then ends ffmpeg and its children
      ::signal(SIGPIPE, SIG_DFL);
      take_signals_again();
      ::prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0);
      if (::getppid() != parent) ::_exit(127);  // the parent ended before
      ::dup2(ends[0], STDIN_FILENO);
      ::dup2(messages, STDOUT_FILENO);
      ::dup2(messages, STDERR_FILENO);
      ::execv(program.c_str(), argv.data());
      ::_exit(127);
    }
    ::close(ends[0]);
    pipe_ = ends[1];
    if (id_ < 0) refuse_film(film_, fmt::format("no process can be made: {}", reason_of(why)));
    ::setpgid(id_, id_);  // both processes set it, because either may run first
    undo_.emplace([id = id_] {
      ::kill(-id, SIGKILL);
      ::waitpid(id, nullptr, 0);
    });
  }
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
  /// Also ends the input. `is_early`: ffmpeg did not read all of it.
  void end(bool is_early) {
    close_pipe();
    std::string failure = failure_of("ffmpeg", wait());
    if (failure.empty() && is_early) failure = "ffmpeg ended before it had all pictures";
    if (failure.empty()) return;
    std::string text;
    std::rewind(messages_.get());
    for (int c; (c = std::fgetc(messages_.get())) != EOF && text.size() < (1u << 20);) text += static_cast<char>(c);
    const std::vector<std::string> lines = last_lines_of(text);
    refuse_film(film_, lines.empty() ? failure : fmt::format("{}; it printed: {}", failure, fmt::join(lines, " | ")));
  }

  fs::path film_, target_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> messages_;
  std::optional<MadeFolders> folders_;
  std::optional<Hidden> written_;
  pid_t id_ = -1;
  int pipe_ = -1;
  std::optional<Undo> undo_;  // newer than the hidden file's, so ffmpeg ends before the file is deleted
};

Film::Film(const fs::path& path, int width, int height, FilmRate rate)
    : process_(std::make_unique<Process>(path, width, height, rate)), width_(width), height_(height) {}
Film::~Film() = default;

void Film::add(const Image& picture) {
  if (picture.width() != width_ || picture.height() != height_ || info(picture.format()).texel_bytes() != 4)
    throw Error(ExitCode::internal, fmt::format("film: expected an rgba8 picture of {}x{}", width_, height_));
  std::vector<std::byte> bytes(static_cast<std::size_t>(3) * width_ * height_);
  std::byte* out = bytes.data();
  for (int y = 0; y < height_; ++y) {
    const std::byte* in = picture.row_bytes(y);
    for (int x = 0; x < width_; ++x, in += 4, out += 3) std::copy_n(in, 3, out);
  }
  process_->write(bytes);
  ++pictures_;
}

void Film::finish() { process_->finish(); }

}  // namespace rainref::cli
