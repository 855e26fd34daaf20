#include <windows.h>

#include <io.h>
#include <psapi.h>

#include "base/machine.h"
#include "base/path_text.h"

namespace rainref::machine {

namespace fs = std::filesystem;

std::optional<std::string> variable(const char* name) {
  const std::wstring wide(name, name + std::char_traits<char>::length(name));  // names are ASCII
  ::SetLastError(ERROR_SUCCESS);
  std::wstring value(::GetEnvironmentVariableW(wide.c_str(), nullptr, 0), L'\0');
  if (value.empty()) return ::GetLastError() == ERROR_ENVVAR_NOT_FOUND ? std::nullopt : std::optional<std::string>("");
  value.resize(::GetEnvironmentVariableW(wide.c_str(), value.data(), static_cast<DWORD>(value.size())));
  return system_path_text(value);
}

// XDG_CACHE_HOME as elsewhere, because scripts may set it.
fs::path cache_folder() {
  for (const char* name : {"XDG_CACHE_HOME", "LOCALAPPDATA"}) {
    const fs::path path = utf8_path(variable(name).value_or(""));
    if (path.is_absolute()) return path;
  }
  return {};
}

std::string host_name() {
  std::wstring name(256, L'\0');
  auto size = static_cast<DWORD>(name.size());
  if (!::GetComputerNameExW(ComputerNameDnsHostname, name.data(), &size)) return "-";
  name.resize(size);
  return system_path_text(name);
}

std::size_t most_memory() {
  PROCESS_MEMORY_COUNTERS counters{};
  return ::K32GetProcessMemoryInfo(::GetCurrentProcess(), &counters, sizeof counters) ? counters.PeakWorkingSetSize : 0;
}

// _isatty is true of NUL too.
bool is_terminal(std::FILE* stream) {
  const auto handle = reinterpret_cast<HANDLE>(::_get_osfhandle(::_fileno(stream)));
  DWORD mode = 0;
  return ::GetConsoleMode(handle, &mode) && ::SetConsoleMode(handle, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
}

bool reader_is_gone(std::FILE*) { return false; }  // a write to such a pipe says so itself, and nothing ends of it

}  // namespace rainref::machine
