#include "cli/terminal.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <string>

#include "base/machine.h"
#include "base/printable.h"
#include "base/system_failure.h"

namespace rainref::cli {

void print_text(std::string_view text) { print_report(printable(text)); }
void print_aside(std::string_view text) {
  const std::string shown = printable(text);
  std::fwrite(shown.data(), 1, shown.size(), stderr);
}
void print_report(std::string_view report) {
  if (std::fwrite(report.data(), 1, report.size(), stdout) < report.size()) throw_system_error(errno);
}

void complain(std::string_view message) {
  std::string line(message);
  std::replace(line.begin(), line.end(), '\n', ' ');  // a file name may contain newlines
  line = printable("rainref: " + line + "\n");
  std::fwrite(line.data(), 1, line.size(), stderr);
}

bool reader_is_gone() { return machine::reader_is_gone(stdout); }

}  // namespace rainref::cli
