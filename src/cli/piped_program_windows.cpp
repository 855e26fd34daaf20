#include "cli/piped_program.h"

#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "base/interruption.h"
#include "base/path_text.h"
#include "base/system.h"
#include "cli/child_process_windows.h"
#include "cli/command_end.h"

namespace rainref::cli {

class PipedProgram::Process {
 public:
  Process(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
    std::vector<std::string> words{system_path_text(program)};
    words.insert(words.end(), arguments.begin(), arguments.end());
    Pipe input = make_pipe(), messages = make_pipe();
    if (!input.writing || !messages.writing) throw std::runtime_error(fmt::format("no pipe: {}", last_reason()));
    const Uninterrupted scope;
    child_ = start_process(program, command_line(words), environment_with({}),
                           {input.reading.get(), messages.writing.get(), messages.writing.get()});
    if (!child_.process) throw std::runtime_error(fmt::format("no process can be made: {}", last_reason()));
    undo_.emplace([this] { child_.kill(); });
    input_ = std::move(input.writing);
    messages_ = std::move(messages.reading);
    reader_ = std::thread([this] { read_messages(); });
  }
  ~Process() {
    child_.kill();
    end();
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  bool write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      DWORD count = 0;
      if (!::WriteFile(input_.get(), bytes.data(), static_cast<DWORD>(bytes.size()), &count, nullptr)) {
        const DWORD why = ::GetLastError();
        if (why == ERROR_BROKEN_PIPE || why == ERROR_NO_DATA) return false;
        throw_system_error(EIO);
      }
      bytes = bytes.subspan(count);
    }
    return true;
  }
  /// Returns the exit code, once.
  int end() {
    input_.close();
    const DWORD code = child_.wait();
    child_.kill();  // what it started may hold the other pipe
    if (reader_.joinable()) reader_.join();
    const Uninterrupted scope;
    undo_.reset();
    return static_cast<int>(code);
  }
  const std::string& printed() const { return text_; }

 private:
  void read_messages() {
    char buffer[4096];
    for (DWORD count = 0; ::ReadFile(messages_.get(), buffer, sizeof buffer, &count, nullptr) && count > 0;)
      if (text_.size() < (1u << 20)) text_.append(buffer, count);
  }

  ChildProcess child_;
  Handle input_, messages_;
  std::string text_;
  std::thread reader_;
  std::optional<Undo> undo_;
};

PipedProgram::PipedProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments)
    : process_(std::make_unique<Process>(program, arguments)) {}
PipedProgram::~PipedProgram() = default;
bool PipedProgram::write(std::span<const std::byte> bytes) { return process_->write(bytes); }
CommandEnd PipedProgram::end(const std::string& name) {
  std::string failure = failure_of(name, process_->end());
  return {std::move(failure), last_lines_of(process_->printed())};
}

}  // namespace rainref::cli
