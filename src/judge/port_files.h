// The files of a port, and their errors.
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
#include "port_dump/kept.h"
#include "port_dump/port_info.h"
#include "rainref/error.h"

namespace rainref::judge {

/// Collects errors of files, so that the user sees all of them at once and the rest is judged.
class FileFaults {
 public:
  /// Runs `read` and keeps its Error. Returns true if there was none.
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
  /// Throws if one of the errors is not a fault of a port's file (the pack is damaged, a defect): nothing is judged then.
  void require_files() const;

 private:
  std::vector<FileFault> faults_;
};

/// Combines all into one Error with the most serious code that names the first few. There must be at least one.
Error files_error(const std::vector<FileFault>& faults);
/// "out.colour, out.mask": the buffers of one run whose files are unusable; "" if there are none.
std::string unusable_text(const std::vector<FileFault>& faults, const std::string& id);

/// Buffers read from ports' files, kept for later use: the first ones, up to a total size. Others are read again.
struct ReadBuffers {
  std::map<std::string, capture::Array> arrays;     ///< by file and shape
  std::map<std::string, port_dump::KeptForm> kept;  ///< of these, where something is open
  std::size_t bytes = 0;                            ///< of all arrays
};

/// A port's folder.
class PortFiles {
 public:
  /// Reads port.json. Throws Error(port_files) if there is no such folder. This effect's buffers whose alpha is declared as the constant 1
  /// may be stored without it. `buffers`: cache for what is read; null: none.
  PortFiles(std::filesystem::path folder, const std::string& effect, const std::string& variant,
            std::shared_ptr<ReadBuffers> buffers = nullptr);
  const std::filesystem::path& folder() const { return folder_; }
  const port_dump::PortInfo& info() const { return info_; }
  /// Reads a buffer like port_dump::read_port_buffer; `run` is the folder of the run. Sets `kept`, if it is not null, to what the buffer's
  /// form leaves open.
  capture::Array read(const std::filesystem::path& run, const std::string& stem, const capture::Array& expected,
                      port_dump::KeptForm* kept = nullptr);
  /// True if the port has anything like an output of the pass of this run, in whatever run: a wrong name does not mean that nothing was
  /// intended.
  bool has_output(const std::string& run) const;
  /// Notes for the reader of a report about accepted files, each once, and about the port's own forms of buffers that leave something open.
  std::vector<std::string> notes() const;

 private:
  /// Remembers for the notes what a buffer's form leaves open.
  void note_kept(const std::string& stem, const port_dump::KeptForm& form);

  std::filesystem::path folder_;
  std::set<std::string> alpha_1_;  ///< names of buffers with constant alpha 1
  port_dump::PortInfo info_;
  std::shared_ptr<ReadBuffers> buffers_;
  std::vector<std::string> notes_;
  std::map<std::string, double> rounded_;                          ///< the largest Kept::widest of each buffer
  std::map<std::string, std::vector<std::string>> from_expected_;  ///< Kept::from_expected of each list
};

/// Throws Error(code) if two paths name one folder or file, so that a pack's expected outputs are never judged by themselves. `code`: usage
/// for a folder that the user named, port_files for a file of the port.
void require_apart(const std::filesystem::path& pack, const std::filesystem::path& port, ExitCode code);

}  // namespace rainref::judge
