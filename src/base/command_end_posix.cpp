#include <string.h>
#include <sys/wait.h>

#include <fmt/format.h>

#include "base/command_end.h"

namespace rainref {
namespace {

std::string signal_text(int signal) { return fmt::format("signal {} ({})", signal, ::strsignal(signal)); }

}  // namespace

std::string failure_of(const std::string& what, int status) {
  if (WIFSIGNALED(status)) return fmt::format("{} was ended by {}", what, signal_text(WTERMSIG(status)));
  const int code = WEXITSTATUS(status);
  if (code == 0) return "";
  // A shell reports a child's signal this way.
  if (code > 128 && code <= 128 + 64) return fmt::format("{} ended with exit code {}: {}", what, code, signal_text(code - 128));
  return fmt::format("{} ended with exit code {}{}", what, code,
                     code == 127   ? ": there is no such program"
                     : code == 126 ? ": it is no program"
                                   : "");
}

}  // namespace rainref
