// A progress bar on the terminal.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace rainref::cli {

/// Frames (or another unit) done, rate and time left, on one line of standard error that is redrawn ten times a second at most. Silent
/// when standard error is no terminal.
class Progress {
 public:
  Progress(std::string what, int total, const char* unit = "frames");
  ~Progress();
  void advance();
  /// Shows this in its place until it advances: what takes long meanwhile.
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
