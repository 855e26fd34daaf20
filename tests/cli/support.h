// Runs the command line in a process and a folder of its own, and says what it printed and left behind.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <source_location>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/npy.h"
#include "base/shell.h"
#include "base/temporary_folder.h"
#include "cli/cli.h"
#include "registry/registry.h"
#include "image_io/codec.h"
#include "image_io/tiny_files.h"
#include "image_io/write.h"

namespace rainref::cli {

/// "'puddle', 'windshield'": every effect, as messages list them.
inline std::string effect_list() {
  std::vector<std::string> names;
  for (const effect::Effect* e : registry::effects()) names.push_back("'" + e->name + "'");
  return fmt::format("{}", fmt::join(names, ", "));
}

struct Outcome {
  int code = -1;  ///< exit code, or minus the signal that ended it
  std::string out, err;
  long peak_kib = 0;  ///< most memory held
};

/// A copy of a process with threads waits for ever under GCC's address sanitizer, where one of them was in its allocator; under its thread
/// sanitizer it may start no thread.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool forks_hang = true;
#else
constexpr bool forks_hang = false;
#endif

/// The program that is asked: the one that was built with this test, or another build of it, as scripts/windows names it.
inline const char* other_program() { return std::getenv("RAINREF_OTHER_PROGRAM"); }
inline std::string program_under_test() { return other_program() ? other_program() : RAINREF_PROGRAM; }

/// What is unusual about the process.
struct Circumstances {
  std::string program = program_under_test();
  std::string standard_output;          ///< a file instead of the test's pipe
  bool closed_error = false;            ///< standard error takes no byte
  bool terminal_error = false;          ///< standard error is a terminal
  rlim_t file_bytes = RLIM_INFINITY;    ///< no file may become longer, as on a full disk
  rlim_t memory_bytes = RLIM_INFINITY;  ///< address space
  /// Not the program but a copy of this process, which calls the same function and shares what this process has loaded:
  /// OpenImageIO takes longer to load than what most tests ask for.
  bool is_copy = false;
};

inline Outcome run_rainref(const std::filesystem::path& folder, std::vector<std::string> arguments, const Circumstances& c = {}) {
  arguments.insert(arguments.begin(), c.program);
  std::vector<char*> argv;
  for (std::string& a : arguments) argv.push_back(a.data());
  argv.push_back(nullptr);
  int out[2], err[2];
  const bool piped = ::pipe(out) == 0 && (c.terminal_error ? ::openpty(&err[0], &err[1], nullptr, nullptr, nullptr) : ::pipe(err)) == 0;
  if (!piped) throw std::runtime_error("no pipe");
  std::fflush(stdout);  // or a copy would print it too
  const pid_t child = ::fork();
  if (child == 0) {
    const auto limit = [](auto resource, rlim_t bytes) {
      if (bytes == RLIM_INFINITY) return;
      const rlimit both{bytes, bytes};
      ::setrlimit(resource, &both);
    };
    if (c.file_bytes != RLIM_INFINITY) ::signal(SIGXFSZ, SIG_IGN);
    limit(RLIMIT_FSIZE, c.file_bytes);
    limit(RLIMIT_AS, c.memory_bytes);
    const int instead = c.standard_output.empty() ? -1 : ::open(c.standard_output.c_str(), O_WRONLY);
    ::dup2(instead >= 0 ? instead : out[1], STDOUT_FILENO);
    ::dup2(c.closed_error ? ::open("/dev/full", O_WRONLY) : err[1], STDERR_FILENO);
    for (const int descriptor : {out[0], out[1], err[0], err[1]}) ::close(descriptor);
    if (::chdir(folder.c_str()) != 0) ::_exit(127);
    if (c.is_copy && !forks_hang && !other_program()) ::_exit(cli::main(static_cast<int>(arguments.size()), argv.data()));
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  ::close(out[1]);
  ::close(err[1]);
  Outcome result;
  std::string* const text[2] = {&result.out, &result.err};
  pollfd waiting[2] = {{out[0], POLLIN, 0}, {err[0], POLLIN, 0}};
  for (int open = 2; open > 0;) {
    ::poll(waiting, 2, -1);
    for (int i = 0; i < 2; ++i) {
      if (waiting[i].fd < 0 || waiting[i].revents == 0) continue;
      char buffer[4096];
      const ssize_t count = ::read(waiting[i].fd, buffer, sizeof buffer);
      if (count > 0) {
        text[i]->append(buffer, static_cast<std::size_t>(count));
      } else {
        waiting[i].fd = -1;  // poll passes over it
        --open;
      }
    }
  }
  ::close(out[0]);
  ::close(err[0]);
  int status = 0;
  rusage usage{};
  ::wait4(child, &status, 0, &usage);
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  result.peak_kib = usage.ru_maxrss;
  return result;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

/// One list behind the other.
inline std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// An outcome has this exit code, and its output and errors match.
inline void expect(const Outcome& o, int code, const testing::Matcher<const std::string&>& out = testing::_,
                   const testing::Matcher<const std::string&>& err = testing::_,
                   const std::source_location& at = std::source_location::current()) {
  const testing::ScopedTrace trace(at.file_name(), static_cast<int>(at.line()), "");
  EXPECT_EQ(o.code, code) << o.out << o.err;
  EXPECT_THAT(o.out, out);
  EXPECT_THAT(o.err, err);
}

/// A folder with `corrected.toml` and `published.toml`, tiny and under a tiny sky: the street costs a second. The sky is an array, which
/// a run reads by itself: OpenImageIO costs each process a sixth of a second. `sky.png` is the same sky.
class CommandLine : public testing::Test {
 protected:
  CommandLine() {
    // Put together by hand: most tests never need the library that would write it.
    std::vector<std::string> rows(4);
    for (int y = 0; y < 4; ++y) {
      for (int i = 0; i < 32; ++i) {
        if (i % 4 != 3) rows[y] += static_cast<char>(20 + 5 * i + 9 * y);
      }
    }
    put(folder / "sky.npy", npy("'|u1'", "(4, 8, 3)", fmt::format("{}", fmt::join(rows, ""))));
    put(folder / "sky.png", image_io::png(8, 4, 8, 2, rows));
    put(folder / "corrected.toml", scene("corrected", "[puddle]\ngrid = [40, 30]\ncell_size = 0.02\nground_image = 'sky.npy'\n"));
    put(folder / "published.toml", scene("as-published"));
    before = folder.names();
  }

  /// The sky's line is 7; `rest` starts at line 8. The sky is the ground too: asphalt takes longer than the rest.
  static std::string scene(const std::string& variant, const std::string& rest = "") {
    return fmt::format("effect = 'puddle'\nvariant = '{}'\n[run]\nframes = 2\nsize = [24, 16]\n[environment]\nimage = 'sky.npy'\n{}",
                       variant, rest.empty() ? "[puddle]\nground_image = 'sky.npy'\n" : rest);
  }

  Outcome rainref(const std::vector<std::string>& arguments, const Circumstances& c = {}) const {
    return run_rainref(folder.path(), arguments, c);
  }
  /// In a copy of this process.
  Outcome copied(const std::vector<std::string>& arguments, Circumstances c = {}) const {
    c.is_copy = true;
    return rainref(arguments, c);
  }
  /// What succeeds without a word on standard error.
  static Outcome good(const Outcome& o) {
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(o.err, "");
    return o;
  }

  /// Refused: this exit code, nothing on standard output, one line on standard error, and no new file.
  void expect_refusal(const std::vector<std::string>& arguments, int code, const testing::Matcher<const std::string&>& message,
                      const Circumstances& c = {}) const {
    SCOPED_TRACE(fmt::format("rainref {}", fmt::join(arguments, " ")));
    const Outcome o = copied(arguments, c);
    EXPECT_EQ(o.code, code);
    EXPECT_EQ(o.out, "");
    ASSERT_THAT(o.err, testing::StartsWith("rainref: "));
    EXPECT_EQ(o.err.find('\n'), o.err.size() - 1) << o.err;
    EXPECT_THAT(o.err.substr(9, o.err.size() - 10), message);
    EXPECT_EQ(folder.names(), before);
  }
  /// `run` of a scene file x.toml with this text, which is refused with this message.
  void expect_scene_refused(const std::string& text, const testing::Matcher<const std::string&>& message) {
    put(folder / "x.toml", text);
    before = folder.names();
    expect_refusal({"run", "x.toml", "-o", "new/deep"}, 2, message);
  }

  /// The names in a folder, in order; none where there is no such folder.
  std::vector<std::string> names(const std::string& in) const {
    std::vector<std::string> out;
    std::error_code error;
    for (std::filesystem::directory_iterator i(folder / in, error), end; !error && i != end; i.increment(error))
      out.push_back(i->path().filename());
    std::sort(out.begin(), out.end());
    return out;
  }

  /// What a command of the shell prints in the folder; it must succeed.
  std::string output(const std::string& command) const {
    const auto [text, status] = output_of(fmt::format("cd '{}' && {}", folder.path().string(), command));
    EXPECT_EQ(status, 0) << command << '\n' << text;
    return text;
  }

  /// Hash lines of a scene; fails the test when they cannot be had.
  std::vector<std::string> hash(const std::vector<std::string>& arguments) const {
    return lines_of(good(copied(joined({"hash"}, arguments))).out);
  }

  TemporaryFolder folder;
  std::vector<std::string> before;
};

}  // namespace rainref::cli
