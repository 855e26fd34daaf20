// How a child process ended.
#pragma once

#include <string>
#include <vector>

namespace rainref::cli {

/// One sentence about `what` from a waitpid status; "" for exit code 0.
std::string failure_of(const std::string& what, int status);

/// The last 20 lines of a text.
std::vector<std::string> last_lines_of(const std::string& text);

}  // namespace rainref::cli
