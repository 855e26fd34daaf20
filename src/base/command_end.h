// How a child process ended. CMake compiles one of command_end_<system>.cpp.
#pragma once

#include <string>
#include <vector>

namespace rainref {

/// How a command ended.
struct CommandEnd {
  std::string failure;                  ///< one sentence; "" if the exit code was 0
  std::vector<std::string> last_lines;  ///< of its standard output and standard error, at most 20
};

/// One sentence about `what` from the status of waitpid or, on Windows, of GetExitCodeProcess; "" for exit code 0.
std::string failure_of(const std::string& what, int status);

/// The last 20 lines of a text.
std::vector<std::string> last_lines_of(const std::string& text);

}  // namespace rainref
