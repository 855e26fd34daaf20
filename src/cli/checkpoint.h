// Runs that may be killed: their state in the folder of the results, and going on from it.
#pragma once

#include <filesystem>
#include <optional>

#include <nlohmann/json_fwd.hpp>

#include "capture/hashing.h"
#include "cli/commands.h"
#include "simulation/opened.h"

namespace rainref::cli {

/// What a run has made besides its files, and its summary needs.
struct RunSoFar {
  double seconds = 0;
  std::vector<capture::HashRecorder::Time> times;
};

/// The file checkpoint.state of a folder.
class Checkpoint {
 public:
  Checkpoint(const std::filesystem::path& folder, const RunOptions& options);

  /// Bytes of the file; nothing where there is none.
  std::optional<std::uintmax_t> bytes() const;
  /// Goes on where the file says: the state into `opened`, and the comparisons with truth so far into `truth`. Throws Error(usage) for a
  /// file that is none, damaged, of another scene, or of a run that asked for other pictures; Error(io) where it cannot be read.
  RunSoFar resume(simulation::Opened& opened, nlohmann::ordered_json& truth) const;
  /// Puts the file in the place of the one before, once it is whole. Throws Error(io).
  void write(const simulation::Opened& opened, const RunSoFar& so_far, const nlohmann::ordered_json& truth) const;
  /// Throws Error(io).
  void remove() const;

 private:
  nlohmann::ordered_json asked() const;

  std::filesystem::path path_;
  const RunOptions& options_;
};

}  // namespace rainref::cli
