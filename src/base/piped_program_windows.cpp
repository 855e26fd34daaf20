#include "base/piped_program.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "base/child_process_windows.h"
#include "base/command_end.h"
#include "base/interruption.h"
#include "base/path_text.h"
#include "base/system.h"

namespace rainref {

class PipedProgram::Process {
 public:
  Process(const std::filesystem::path& program, const std::vector<std::string>& arguments, PipedProgram::Pipe pipe) {
    const bool reads = pipe == PipedProgram::Pipe::to_input;
    std::vector<std::string> words{system_path_text(program)};
    words.insert(words.end(), arguments.begin(), arguments.end());
    rainref::Pipe data = make_pipe(), messages = make_pipe();
    if (!data.writing || !messages.writing) throw std::runtime_error(fmt::format("no pipe: {}", last_reason()));
    const Uninterrupted scope;
    child_ = start_process(program, command_line(words), environment_with({}),
                           {reads ? data.reading.get() : nullptr, (reads ? messages : data).writing.get(), messages.writing.get()});
    if (!child_.process) throw std::runtime_error(fmt::format("no process can be made: {}", last_reason()));
    undo_.emplace([this] { child_.kill(); });
    data_ = std::move(reads ? data.writing : data.reading);
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
      if (!::WriteFile(data_.get(), bytes.data(), static_cast<DWORD>(bytes.size()), &count, nullptr)) {
        const DWORD why = ::GetLastError();
        if (why == ERROR_BROKEN_PIPE || why == ERROR_NO_DATA) return false;
        throw_system_error(EIO);
      }
      bytes = bytes.subspan(count);
    }
    return true;
  }
  std::size_t read(std::span<std::byte> bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
      DWORD count = 0;
      const auto wanted = static_cast<DWORD>(std::min<std::size_t>(bytes.size() - done, 1 << 30));
      if (!::ReadFile(data_.get(), bytes.data() + done, wanted, &count, nullptr)) {
        if (::GetLastError() == ERROR_BROKEN_PIPE) break;
        throw_system_error(EIO);
      }
      if (count == 0) break;
      done += count;
    }
    return done;
  }
  /// Returns the exit code, once.
  int end() {
    data_.close();
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
  Handle data_, messages_;
  std::string text_;
  std::thread reader_;
  std::optional<Undo> undo_;
};

PipedProgram::PipedProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments, Pipe pipe)
    : process_(std::make_unique<Process>(program, arguments, pipe)) {}
PipedProgram::~PipedProgram() = default;
bool PipedProgram::write(std::span<const std::byte> bytes) { return process_->write(bytes); }
std::size_t PipedProgram::read(std::span<std::byte> bytes) { return process_->read(bytes); }
CommandEnd PipedProgram::end(const std::string& name) {
  std::string failure = failure_of(name, process_->end());
  return {std::move(failure), last_lines_of(process_->printed())};
}

}  // namespace rainref
