// Output of the command line. All output passes through here, so that no byte from a port, a pack or a file name can control a terminal.
#pragma once

#include <string_view>

#include <fmt/format.h>

namespace rainref::cli {

/// Prints to standard output, through printable(). Throws std::system_error if writing fails.
void print_text(std::string_view text);
/// Prints to standard error, through printable(): text for standard output when a report is written there. Failures are ignored.
void print_aside(std::string_view text);
/// Writes a machine-readable report to standard output, unchanged. Throws like print_text.
void print_report(std::string_view report);
template <typename... T>
void say(fmt::format_string<T...> format, T&&... arguments) {
  print_text(fmt::format(format, std::forward<T>(arguments)...));
}

/// Prints "rainref: " and the message as one line on standard error. Failures are ignored, because they cannot be reported.
void complain(std::string_view message);

/// True if nobody reads standard output any more, for example after `head` has ended.
bool reader_is_gone();

}  // namespace rainref::cli
