// Child processes of Windows. Each has a job of its own: all that it starts is in the job and ends with the job's last handle, however this
// process dies.
#pragma once

#include <windows.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace rainref {

/// Owns a handle; nullptr is none.
class Handle {
 public:
  Handle(HANDLE handle = nullptr) : handle_(handle == INVALID_HANDLE_VALUE ? nullptr : handle) {}
  Handle(Handle&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Handle() { close(); }
  void close() {
    if (handle_) ::CloseHandle(std::exchange(handle_, nullptr));
  }
  HANDLE get() const { return handle_; }
  explicit operator bool() const { return handle_ != nullptr; }

 private:
  HANDLE handle_;
};

/// The same text in UTF-16. Bytes that are not UTF-8 are replaced.
std::wstring wide(const std::string& utf8);
/// One command line that the child's C library splits into these words again.
std::wstring command_line(const std::vector<std::string>& words);
/// This process's environment with more variables ("NAME=value"), which override it.
std::wstring environment_with(const std::vector<std::string>& more);
/// The system's text for GetLastError().
std::string last_reason();

/// Handles for a child; nullptr: NUL.
struct Streams {
  HANDLE input = nullptr, output = nullptr, error = nullptr;
};
struct ChildProcess {
  Handle process, job;

  /// Kills it and all that it started.
  void kill() const { ::TerminateJobObject(job.get(), 1); }
  /// Waits for its end. Returns its exit code.
  DWORD wait() const;
};
/// Starts a program in a job. It inherits these streams and no other handle. Its Ctrl-C is this process's. Returns no process after a
/// failure.
ChildProcess start_process(const std::filesystem::path& program, std::wstring line, const std::wstring& variables, const Streams& streams);

struct Pipe {
  Handle reading, writing;
};
/// Both ends are nullptr after a failure.
Pipe make_pipe();

}  // namespace rainref
