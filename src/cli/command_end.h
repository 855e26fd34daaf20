// How a program that was started has ended.
#pragma once

#include <string>
#include <vector>

namespace rainref::cli {

/// One sentence about `what` from the status that waitpid gives; "" for exit code 0.
std::string failure_of(const std::string& what, int status);

/// The lines of a text, the last 20 of them.
std::vector<std::string> last_lines_of(const std::string& text);

}  // namespace rainref::cli
