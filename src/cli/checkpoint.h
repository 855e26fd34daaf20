// Checkpoints of runs that may be killed: their state in the results folder, from which they resume.
#pragma once

#include <filesystem>
#include <optional>

#include <nlohmann/json_fwd.hpp>

#include "capture/hashing.h"
#include "cli/commands.h"
#include "simulation/opened.h"

namespace rainref::cli {

/// Results of a run that are not in files but are needed for its summary.
struct RunSoFar {
  double seconds = 0;
  std::vector<capture::HashRecorder::Time> times;
};

/// The file checkpoint.state of a folder.
class Checkpoint {
 public:
  Checkpoint(const std::filesystem::path& folder, const RunOptions& options);

  /// Size of the file; nothing if there is none.
  std::optional<std::uintmax_t> bytes() const;
  /// Resumes from the file: sets `opened` to the state and `truth` to the comparisons so far. Throws Error(usage) if the file is no
  /// checkpoint, is damaged, or belongs to another scene or to a run with other picture options; Error(io) if it cannot be read.
  RunSoFar resume(simulation::Opened& opened, nlohmann::ordered_json& truth) const;
  /// Writes the file, and replaces the previous one when it is complete. Throws Error(io).
  void write(const simulation::Opened& opened, const RunSoFar& so_far, const nlohmann::ordered_json& truth) const;
  /// Throws Error(io).
  void remove() const;

 private:
  nlohmann::ordered_json asked() const;

  std::filesystem::path path_;
  const RunOptions& options_;
};

}  // namespace rainref::cli
