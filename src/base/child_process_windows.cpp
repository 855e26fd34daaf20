#include "base/child_process_windows.h"

#include <algorithm>
#include <cstddef>
#include <cwchar>
#include <system_error>

namespace rainref {
namespace {

// As the C library of the child reads it: backslashes count only before a quotation mark.
void add_word(std::string& line, const std::string& word) {
  if (!line.empty()) line += ' ';
  if (!word.empty() && word.find_first_of(" \t\n\v\"") == std::string::npos) {
    line += word;
    return;
  }
  line += '"';
  std::size_t backslashes = 0;
  for (const char c : word) {
    if (c == '"') line.append(backslashes + 1, '\\');  // as many again, and one for the quotation mark
    backslashes = c == '\\' ? backslashes + 1 : 0;
    line += c;
  }
  line.append(backslashes, '\\') += '"';
}

/// The list of handles that a child inherits.
class Inherited {
 public:
  explicit Inherited(std::vector<HANDLE> handles) : handles_(std::move(handles)) {
    std::sort(handles_.begin(), handles_.end());
    handles_.erase(std::unique(handles_.begin(), handles_.end()), handles_.end());
    for (const HANDLE handle : handles_) ::SetHandleInformation(handle, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
    SIZE_T bytes = 0;
    ::InitializeProcThreadAttributeList(nullptr, 1, 0, &bytes);
    memory_.resize(bytes);
    ::InitializeProcThreadAttributeList(list(), 1, 0, &bytes);
    ::UpdateProcThreadAttribute(list(), 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST, handles_.data(), handles_.size() * sizeof(HANDLE), nullptr,
                                nullptr);
  }
  ~Inherited() { ::DeleteProcThreadAttributeList(list()); }
  Inherited(const Inherited&) = delete;
  Inherited& operator=(const Inherited&) = delete;
  LPPROC_THREAD_ATTRIBUTE_LIST list() { return reinterpret_cast<LPPROC_THREAD_ATTRIBUTE_LIST>(memory_.data()); }

 private:
  std::vector<HANDLE> handles_;
  std::vector<std::byte> memory_;
};

Handle new_job() {
  Handle job = ::CreateJobObjectW(nullptr, nullptr);
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
  limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
  ::SetInformationJobObject(job.get(), JobObjectExtendedLimitInformation, &limits, sizeof limits);
  return job;
}

}  // namespace

std::wstring wide(const std::string& utf8) {
  const int bytes = static_cast<int>(utf8.size());
  std::wstring out(static_cast<std::size_t>(::MultiByteToWideChar(CP_UTF8, 0, utf8.data(), bytes, nullptr, 0)), L'\0');
  ::MultiByteToWideChar(CP_UTF8, 0, utf8.data(), bytes, out.data(), static_cast<int>(out.size()));
  return out;
}

std::wstring command_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) add_word(line, word);
  return wide(line);
}

std::wstring environment_with(const std::vector<std::string>& more) {
  std::wstring block;
  std::vector<std::wstring> names;
  for (const std::string& variable : more) {
    block += wide(variable) + L'\0';
    names.push_back(wide(variable.substr(0, variable.find('=') + 1)));
  }
  wchar_t* const all = ::GetEnvironmentStringsW();
  for (const wchar_t* v = all; *v; v += std::wcslen(v) + 1) {
    const auto is_same = [&](const std::wstring& name) { return ::_wcsnicmp(v, name.c_str(), name.size()) == 0; };
    if (std::none_of(names.begin(), names.end(), is_same)) block.append(v) += L'\0';
  }
  ::FreeEnvironmentStringsW(all);
  return block += L'\0';
}

std::string last_reason() { return std::system_category().message(static_cast<int>(::GetLastError())); }

DWORD ChildProcess::wait() const {
  ::WaitForSingleObject(process.get(), INFINITE);
  DWORD code = 0;
  ::GetExitCodeProcess(process.get(), &code);
  return code;
}

ChildProcess start_process(const std::filesystem::path& program, std::wstring line, const std::wstring& variables, const Streams& streams) {
  ChildProcess child;
  child.job = new_job();
  const Handle nothing(
      ::CreateFileW(L"NUL", GENERIC_READ | GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE, nullptr, OPEN_EXISTING, 0, nullptr));
  const auto or_nothing = [&](HANDLE handle) { return handle ? handle : nothing.get(); };
  STARTUPINFOEXW info{};
  info.StartupInfo.cb = sizeof info;
  info.StartupInfo.dwFlags = STARTF_USESTDHANDLES;
  info.StartupInfo.hStdInput = or_nothing(streams.input);
  info.StartupInfo.hStdOutput = or_nothing(streams.output);
  info.StartupInfo.hStdError = or_nothing(streams.error);
  Inherited inherited({info.StartupInfo.hStdInput, info.StartupInfo.hStdOutput, info.StartupInfo.hStdError});
  info.lpAttributeList = inherited.list();
  constexpr DWORD flags = CREATE_SUSPENDED | CREATE_UNICODE_ENVIRONMENT | EXTENDED_STARTUPINFO_PRESENT;
  PROCESS_INFORMATION made{};
  if (!::CreateProcessW(program.c_str(), line.data(), nullptr, nullptr, TRUE, flags, const_cast<wchar_t*>(variables.c_str()), nullptr,
                        &info.StartupInfo, &made))
    return child;
  child.process = made.hProcess;
  ::AssignProcessToJobObject(child.job.get(), made.hProcess);  // before it can start another
  ::ResumeThread(made.hThread);
  ::CloseHandle(made.hThread);
  return child;
}

Pipe make_pipe() {
  HANDLE reading = nullptr, writing = nullptr;
  if (!::CreatePipe(&reading, &writing, nullptr, 1 << 16)) return {};
  return {reading, writing};
}

}  // namespace rainref
