#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <fstream>

#include "base/machine.h"

namespace rainref::machine {

namespace fs = std::filesystem;

std::optional<std::string> variable(const char* name) {
  const char* const value = std::getenv(name);
  return value ? std::optional<std::string>(value) : std::nullopt;
}

fs::path cache_folder() {
  const auto folder = [](const char* name) {
    const fs::path path = variable(name).value_or("");
    return path.is_absolute() ? path : fs::path();  // relative paths must be ignored (XDG Base Directory Specification 0.8)
  };
  if (fs::path cache = folder("XDG_CACHE_HOME"); !cache.empty()) return cache;
  const fs::path home = folder("HOME");
  return home.empty() ? home : home / ".cache";
}

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "-";
}

// Linux alone tells it.
std::size_t most_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string key; status >> key; status.ignore(1 << 10, '\n')) {
    std::size_t kib = 0;
    if (key == "VmHWM:" && status >> kib) return kib << 10;
  }
  return 0;
}

bool is_terminal(std::FILE* stream) { return ::isatty(::fileno(stream)) != 0; }

bool reader_is_gone(std::FILE* stream) {
  pollfd output{::fileno(stream), 0, 0};
  return ::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

}  // namespace rainref::machine
