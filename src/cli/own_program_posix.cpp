#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

#include <fmt/format.h>

#include "base/path_text.h"
#include "base/process_control.h"
#include "base/signals.h"
#include "base/system_failure.h"
#include "cli/own_program.h"
#include "cli/own_words.h"
#include "rainref/error.h"

extern char** environ;

namespace rainref::cli {
namespace {

// Runs after fork(): may only call what a signal handler may call.
[[noreturn]] void become(const char* program, char** arguments, char** variables, int output, int error, pid_t parent) {
  take_signals_again();
  ::prctl(PR_SET_PDEATHSIG, SIGTERM, 0, 0, 0);
  if (::getppid() != parent) ::_exit(127);  // the parent ended before
  if (output >= 0) ::dup2(output, STDOUT_FILENO);
  if (error >= 0) ::dup2(error, STDERR_FILENO);
  ::execve(program, arguments, variables);
  ::_exit(127);
}

int opened(const std::filesystem::path& path) {
  if (path.empty()) return -1;
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) throw Error(ExitCode::io, fmt::format("cannot write '{}': {}", path_text(path), reason_of(errno)));
  return descriptor;
}

}  // namespace

int run_own_program(const std::vector<std::string>& arguments, const std::string& variable, const ChildOutput& to) {
  const std::string program = path_text(own_program());
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv, variables;
  for (std::string& word : words) argv.push_back(word.data());
  std::string added = variable;
  if (!added.empty()) variables.push_back(added.data());  // first, so that it overrides a variable of the same name
  for (char** v = environ; *v; ++v) variables.push_back(*v);
  argv.push_back(nullptr);
  variables.push_back(nullptr);
  const int output = opened(to.standard_output), error = opened(to.standard_error);
  const pid_t parent = ::getpid(), child = ::fork();
  if (child == 0) become(own_program_name(), argv.data(), variables.data(), output, error, parent);
  const int why = errno;
  for (const int descriptor : {output, error})
    if (descriptor >= 0) ::close(descriptor);
  if (child < 0) throw Error(ExitCode::io, fmt::format("no process can be made: {}", reason_of(why)));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

std::string death_text(int code) { return fmt::format("signal {}", -code); }

}  // namespace rainref::cli
