// By cmd.exe, in a job that ends all that came of it.
#include "cli/run_command.h"

#include <algorithm>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "base/child_process_windows.h"
#include "base/command_end.h"
#include "base/interruption.h"
#include "base/path_text.h"
#include "cli/shell_word.h"
#include "rainref/error.h"

namespace rainref::cli {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kept_bytes = 65536;
constexpr std::string_view plain_marks = "/._-\\:~";

// By its whole path: another program of that name may lie in the current folder.
fs::path command_interpreter() {
  std::wstring folder(MAX_PATH, L'\0');
  folder.resize(::GetSystemDirectoryW(folder.data(), static_cast<UINT>(folder.size())));
  return fs::path(folder) / "cmd.exe";
}

/// Keeps the last of what a pipe holds.
void read_all(HANDLE pipe, std::string& text) {
  for (DWORD there = 0; ::PeekNamedPipe(pipe, nullptr, 0, nullptr, &there, nullptr) && there > 0;) {
    char buffer[4096];
    DWORD count = 0;
    if (!::ReadFile(pipe, buffer, sizeof buffer, &count, nullptr) || count == 0) return;
    text.append(buffer, count);
    if (text.size() > 2 * kept_bytes) text.erase(0, text.size() - kept_bytes);
  }
}

}  // namespace

// A volume may give short names: "C:\Users\JODOE~1".
std::string plain_path(const fs::path& path) {
  std::string text = system_path_text(fs::path(path).make_preferred());
  if (is_plain(text, plain_marks)) return text;
  std::wstring name(32768, L'\0');
  name.resize(::GetShortPathNameW(path.c_str(), name.data(), static_cast<DWORD>(name.size())));
  text = system_path_text(name);
  return !text.empty() && is_plain(text, plain_marks) ? text : "";
}

fs::path temporary_folder() {
  std::error_code error;
  fs::path folder = fs::absolute(fs::temp_directory_path(error), error);
  if (error) throw Error(ExitCode::io, fmt::format("--exec: no temporary folder: {}", error.message()));
  if (!folder.has_filename()) folder = folder.parent_path();
  const std::string plain = plain_path(folder);
  return plain.empty() ? folder : utf8_path(plain);
}

std::string link_to(const fs::path& folder, const fs::path&) { return system_path_text(fs::path(folder).make_preferred()); }

std::string in_command(std::string_view before, const std::string& path) {
  const bool is_quoted = std::count(before.begin(), before.end(), '"') % 2 != 0;
  return is_plain(path, plain_marks) || is_quoted ? path : '"' + path + '"';
}

std::string shell_word(std::string_view word) { return quoted_word(word, "_-./\\:~+@#", '"', "\"\""); }

CommandEnd run_command(const std::string& command, std::chrono::duration<double> timeout, const std::vector<std::string>& environment) {
  Pipe pipe = make_pipe();
  if (!pipe.writing) throw Error(ExitCode::io, fmt::format("--exec: no pipe: {}", last_reason()));
  ChildProcess child;
  std::optional<Undo> undo;
  {
    const Uninterrupted scope;
    // /d: without programs that the registry names. /s: the command is what stands between the outer quotation marks.
    child = start_process(command_interpreter(), L"cmd.exe /d /s /c \"" + wide(command) + L"\"", environment_with(environment),
                          {nullptr, pipe.writing.get(), pipe.writing.get()});
    if (!child.process) throw Error(ExitCode::io, fmt::format("--exec: no process: {}", last_reason()));
    undo.emplace([&child] { child.kill(); });
  }
  pipe.writing.close();

  const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(timeout);
  std::string text;
  // The command's end counts, not the pipe's, because another process may keep the pipe open.
  bool timed_out = false;
  while (!timed_out && ::WaitForSingleObject(child.process.get(), 10) == WAIT_TIMEOUT) {
    read_all(pipe.reading.get(), text);
    timed_out = Clock::now() >= end;
  }
  child.kill();
  const DWORD code = child.wait();
  {
    const Uninterrupted scope;
    undo.reset();
  }
  read_all(pipe.reading.get(), text);
  CommandEnd result{failure_of("the port's command", static_cast<int>(code)), last_lines_of(text)};
  if (timed_out) result.failure = fmt::format("the port's command was ended after {:g} s (--timeout)", timeout.count());
  return result;
}

}  // namespace rainref::cli
