#include "c_library/call.h"

#include <algorithm>
#include <array>

namespace rainref::c_library {
namespace {

// A plain array, so that nothing needs destruction if a thread ends after the library was unloaded.
thread_local std::array<char, 8192> last_error{};

}  // namespace

int keep_error(int code, std::string_view text) noexcept {
  std::size_t size = std::min(text.size(), last_error.size() - 1);
  while (size < text.size() && size > 0 && (static_cast<unsigned char>(text[size]) & 0xc0) == 0x80) --size;  // do not cut a character
  std::copy_n(text.data(), size, last_error.data());
  last_error[size] = '\0';
  return code;
}

std::vector<std::string> texts(const char* const* first, std::size_t count, const char* name) {
  std::vector<std::string> out;
  if (count > 0) required(first, name);
  for (std::size_t i = 0; i < count; ++i) out.emplace_back(&required(first[i], name));
  return out;
}

const char* joined(const std::vector<std::string>& lines, std::string& text) {
  text.clear();
  for (const std::string& line : lines) text += line + "\n";
  return text.c_str();
}

Progress progress_of(rr_progress callback, void* user, const char* name, const char* unit) {
  if (!callback) return {};
  return [=](int done, int of) {
    int result = 1;
    try {
      result = callback(user, done, of);
    } catch (...) {
      throw Error(ExitCode::usage, fmt::format("{}: the callback threw an exception", name));
    }
    if (result != 0) throw Error(ExitCode::usage, fmt::format("stopped by {} after {} of {} {}", name, done, of, unit));
  };
}

}  // namespace rainref::c_library

const char* rr_error(void) { return rainref::c_library::last_error.data(); }
