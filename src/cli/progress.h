// A progress bar on the terminal.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace rainref::cli {

/// Shows frames (or another unit) done, rate and time left, on one line of standard error that is redrawn at most ten times per second.
/// Silent if standard error is not a terminal.
class Progress {
 public:
  Progress(std::string what, int total, const char* unit = "frames");
  ~Progress();
  void advance();
  /// Shows the name of a long operation until the bar advances.
  void meanwhile(std::string_view what);

 private:
  using Clock = std::chrono::steady_clock;
  void draw();
  std::string what_;
  const char* unit_;
  int total_, done_ = 0;
  bool shown_;
  Clock::time_point start_, drawn_;
};

/// "1 frame", "2 frames".
std::string counted(long long count, std::string_view what);
/// "4.2 s", "1 min 05 s".
std::string duration_text(double seconds);

}  // namespace rainref::cli
