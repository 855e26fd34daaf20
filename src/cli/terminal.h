// What the command line prints. All of it passes here, so that no byte of a port's output, of a pack or of a file's name can
// command a terminal.
#pragma once

#include <string_view>

#include <fmt/format.h>

namespace rainref::cli {

/// To standard output, through printable(). Throws std::system_error where it takes no more.
void print_text(std::string_view text);
/// To standard error, through printable(): what else goes to standard output, which has a report. Failures are not reported.
void print_aside(std::string_view text);
/// To standard output, byte by byte: a report that a program reads. Throws as print_text.
void print_report(std::string_view report);
template <typename... T>
void say(fmt::format_string<T...> format, T&&... arguments) {
  print_text(fmt::format(format, std::forward<T>(arguments)...));
}

/// "rainref: " and the message, as one line on standard error. Failures are not reported: there is nowhere to.
void complain(std::string_view message);

/// Whether nobody reads standard output any more, such as `head` when it has had enough.
bool reader_is_gone();

}  // namespace rainref::cli
