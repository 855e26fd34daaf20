#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "base/path_text.h"
#include "base/program_path.h"
#include "base/signals.h"
#include "cli/view/browser.h"

namespace rainref::cli {
namespace {

// Runs after fork(): may only call what a signal handler may call. The parent of the browser ends at once, so that the system adopts it.
[[noreturn]] void become(const char* program, const char* address) {
  take_signals_again();
  ::setsid();
  if (::fork() != 0) ::_exit(0);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
  ::execl(program, program, address, static_cast<char*>(nullptr));
  ::_exit(127);
}

}  // namespace

bool open_browser(const std::string& address) {
  const std::filesystem::path program = program_in_path(RAINREF_OPENS_ADDRESSES);
  if (program.empty()) return false;
  const std::string text = path_text(program);
  const pid_t child = ::fork();
  if (child == 0) become(text.c_str(), address.c_str());
  while (child > 0 && ::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  return child > 0;
}

}  // namespace rainref::cli
