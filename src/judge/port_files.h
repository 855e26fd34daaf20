// The files of a port, and all that is wrong with them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "capture/array.h"
#include "judge/verdict.h"
#include "port_dump/port_info.h"
#include "rainref/error.h"

namespace rainref::judge {

/// What is wrong with some files: gathered, so that whoever has to mend them sees all of it at once, and the rest is judged.
class FileFaults {
 public:
  /// Runs `read`; an Error is kept. Whether there was none.
  template <class Read>
  bool attempt(const std::string& pass, const std::string& id, const std::string& output, const Read& read) {
    try {
      read();
      return true;
    } catch (const Error& e) {
      faults_.push_back({e.code(), pass, id, output, e.what()});
      return false;
    }
  }
  const std::vector<FileFault>& all() const { return faults_; }
  /// Throws when one of them is no fault of a file alone (the pack's own is among them, a defect): nothing is judged then.
  void require_files() const;

 private:
  std::vector<FileFault> faults_;
};

/// All of them as one Error with the most serious code, naming the first few. There is at least one.
Error files_error(const std::vector<FileFault>& faults);
/// "out.colour, out.mask": the buffers of one run whose files cannot be used; "" where there are none.
std::string unusable_text(const std::vector<FileFault>& faults, const std::string& id);

/// What was read of ports' files, for whoever asks for it again: the first buffers that come, up to a size. The rest is read anew.
struct ReadBuffers {
  std::map<std::string, capture::Array> arrays;  ///< by file and shape
  std::size_t bytes = 0;                         ///< of them all
};

/// A port's folder.
class PortFiles {
 public:
  /// Reads port.json. Error(port_files) when there is no such folder. Of this effect's buffers those whose alpha is declared as the
  /// constant 1 may be stored without it. `buffers`: where to find and keep what is read; null: nowhere.
  PortFiles(std::filesystem::path folder, const std::string& effect, const std::string& variant,
            std::shared_ptr<ReadBuffers> buffers = nullptr);
  const std::filesystem::path& folder() const { return folder_; }
  const port_dump::PortInfo& info() const { return info_; }
  /// A buffer as port_dump::read_port_buffer gives it; `run` is the folder of the run.
  capture::Array read(const std::filesystem::path& run, const std::string& stem, const capture::Array& expected);
  /// What the reader of a report should know about files that were accepted, each once.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  std::filesystem::path folder_;
  std::set<std::string> alpha_1_;  ///< buffers
  port_dump::PortInfo info_;
  std::shared_ptr<ReadBuffers> buffers_;
  std::vector<std::string> notes_;
};

/// Throws Error(code) when two paths lead to one folder or file: a pack's expected outputs are never judged by themselves. A folder was
/// asked for (usage); a file is the port's (port_files).
void require_apart(const std::filesystem::path& pack, const std::filesystem::path& port, ExitCode code);

}  // namespace rainref::judge
