#include "cli/progress.h"

#include <cstdio>

#include <fmt/format.h>

#include "base/machine.h"

namespace rainref::cli {

std::string duration_text(double seconds) {
  if (seconds < 60) return fmt::format("{:.1f} s", seconds);
  const int whole = static_cast<int>(seconds + 0.5);
  return fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

std::string counted(long long count, std::string_view what) { return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s"); }

Progress::Progress(std::string what, int total, const char* unit)
    : what_(std::move(what)), unit_(unit), total_(total), shown_(machine::is_terminal(stderr)), start_(Clock::now()), drawn_(start_) {
  if (shown_) draw();
}

Progress::~Progress() {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

void Progress::advance() {
  ++done_;
  if (!shown_) return;
  const auto now = Clock::now();
  if (done_ < total_ && now - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = now;
  draw();
}

void Progress::meanwhile(std::string_view what) {
  if (!shown_) return;
  fmt::print(stderr, "\r{}\033[K", what);
  std::fflush(stderr);
}

void Progress::draw() {
  constexpr int width = 24;
  const int filled = total_ > 0 ? width * done_ / total_ : width;
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  std::string line = fmt::format("\r{} [{}{}] {}/{}", what_, std::string(filled, '#'), std::string(width - filled, '.'), done_, total_);
  if (done_ > 0) line += fmt::format("  {:.1f} {}/s  {} left", done_ / elapsed, unit_, duration_text(elapsed / done_ * (total_ - done_)));
  fmt::print(stderr, "{}\033[K", line);
  std::fflush(stderr);
}

}  // namespace rainref::cli
