#include "cli/terminal.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include "base/printable.h"

namespace rainref::cli {

void print_text(std::string_view text) { print_report(printable(text)); }
void print_aside(std::string_view text) {
  const std::string shown = printable(text);
  std::fwrite(shown.data(), 1, shown.size(), stderr);
}
void print_report(std::string_view report) {
  if (std::fwrite(report.data(), 1, report.size(), stdout) < report.size()) throw std::system_error(errno, std::generic_category());
}

void complain(std::string_view message) {
  std::string line(message);
  std::replace(line.begin(), line.end(), '\n', ' ');  // a file name may contain newlines
  line = printable("rainref: " + line + "\n");
  std::fwrite(line.data(), 1, line.size(), stderr);
}

bool reader_is_gone() {
  pollfd output{STDOUT_FILENO, 0, 0};
  return ::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

}  // namespace rainref::cli
