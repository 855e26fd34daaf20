// Errors for the user: one sentence, a place, an exit code.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rainref {

/// Exit codes of the command line. If several apply, the more serious one is returned, in the order 5, 4, 2, 3, 1.
enum class ExitCode : int {
  pass = 0,
  fail = 1,        ///< a check failed, or something was not judged
  usage = 2,       ///< invalid command line or scene, or an input image that cannot be decoded
  port_files = 3,  ///< a port's files are missing or malformed
  io = 4,          ///< a file cannot be read or written, or the disk is full
  internal = 5     ///< a defect of rainref
};

/// A place in a text file; line and column count from 1, and 0 means unknown.
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;
  /// Returns "file:line:column" without unknown parts.
  std::string text() const;
};

/// The exception type of rainref. what() is the whole message for the user.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  Error(ExitCode code, const SourceLocation& at, const std::string& message);
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// Returns the name in `names` that is nearest to `wrong` by edit distance, the earlier one in a tie. Returns "" if the distance is above 1
/// and above a third of the longer name's length: too far for a typo.
std::string nearest_name(std::string_view wrong, std::span<const std::string> names);

/// Returns "; did you mean 'x'?" for the nearest name, or "" if none is near.
std::string did_you_mean(std::string_view wrong, std::span<const std::string> names);

}  // namespace rainref
