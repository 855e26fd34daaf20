#include "cli/own_program.h"

#include <windows.h>

#include <shellapi.h>

#include <fmt/format.h>

#include "base/child_process_windows.h"
#include "base/code_file.h"
#include "base/path_text.h"
#include "rainref/error.h"

namespace rainref::cli {
namespace {

// From here on codes are the system's: of an exception, or of Ctrl-C.
constexpr DWORD first_of_system = 0x80000000u, of_system = 0xC0000000u;

Handle opened(const std::filesystem::path& path) {
  if (path.empty()) return {};
  Handle file(::CreateFileW(path.c_str(), GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr, CREATE_ALWAYS, 0,
                            nullptr));
  if (!file) throw Error(ExitCode::io, fmt::format("cannot write '{}': {}", path_text(path), last_reason()));
  return file;
}

}  // namespace

std::filesystem::path own_program() { return code_file(); }

std::vector<std::string> own_arguments() {
  int count = 0;
  wchar_t** const all = ::CommandLineToArgvW(::GetCommandLineW(), &count);
  std::vector<std::string> words;
  for (int i = 1; i < count; ++i) words.push_back(system_path_text(all[i]));
  ::LocalFree(all);
  return words;
}

int run_own_program(const std::vector<std::string>& arguments, const std::string& variable, const ChildOutput& to) {
  std::vector<std::string> words{system_path_text(own_program())};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const Handle output = opened(to.standard_output), error = opened(to.standard_error);
  const Streams streams{::GetStdHandle(STD_INPUT_HANDLE), output ? output.get() : ::GetStdHandle(STD_OUTPUT_HANDLE),
                        error ? error.get() : ::GetStdHandle(STD_ERROR_HANDLE)};
  const std::vector<std::string> variables = variable.empty() ? std::vector<std::string>() : std::vector<std::string>{variable};
  const ChildProcess child = start_process(own_program(), command_line(words), environment_with(variables), streams);
  if (!child.process) throw Error(ExitCode::io, fmt::format("no process can be made: {}", last_reason()));
  const DWORD code = child.wait();
  return code >= first_of_system ? -static_cast<int>(code & 0xffff) : static_cast<int>(code);
}

std::string death_text(int code) { return fmt::format("exception 0x{:08X}", of_system | static_cast<DWORD>(-code)); }

}  // namespace rainref::cli
