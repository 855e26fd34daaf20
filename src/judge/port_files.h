// The files of a port, and one error for all that is wrong with them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "capture/array.h"
#include "port_dump/port_info.h"
#include "rainref/error.h"

namespace rainref::judge {

/// What is wrong with some files: gathered, so that whoever has to mend them sees all of it at once.
class FileErrors {
 public:
  /// Runs `read`; an Error is kept.
  template <class Read>
  void attempt(const Read& read) {
    try {
      read();
    } catch (const Error& e) {
      errors_.push_back(e);
    }
  }
  /// Throws an Error with the most serious code of all, naming the first few; nothing when there is none.
  void raise() const;

 private:
  std::vector<Error> errors_;
};

/// A port's folder.
class PortFiles {
 public:
  /// Reads port.json. Error(port_files) when there is no such folder.
  explicit PortFiles(std::filesystem::path folder);
  const std::filesystem::path& folder() const { return folder_; }
  const port_dump::PortInfo& info() const { return info_; }
  /// A buffer as port_dump::read_port_buffer gives it; `run` is the folder of the run.
  capture::Array read(const std::filesystem::path& run, const std::string& stem, const capture::Array& expected);
  /// What the reader of a report should know about files that were accepted, each once.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  std::filesystem::path folder_;
  port_dump::PortInfo info_;
  std::vector<std::string> notes_;
};

/// Throws Error(usage) when two paths lead to one folder or file: a pack's expected outputs are never judged by
/// themselves.
void require_apart(const std::filesystem::path& pack, const std::filesystem::path& port);

}  // namespace rainref::judge
