// Races: outputs of a port that differ between runs on the same inputs.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "capture/pack_read.h"
#include "judge/port_files.h"
#include "judge/verdict.h"

namespace rainref::judge {

/// An output that two runs gave differently.
struct Race {
  std::string pass, id, output;
  int run = 0;  ///< the first that differs from run 1; runs count from 1
  bool records = false;
  int x = 0, y = 0, channel = 0;       ///< first element that differs; of records, x is the record
  std::int64_t differing = 0, of = 0;  ///< channel values, or records, that differ in any run
  std::string text() const;
};

/// What runs of a port tell.
struct Races {
  std::vector<Race> found;
  std::vector<FileFault> files;  ///< of the runs after the first: those of the first are validate's
};

/// Compares what runs of a port wrote, each in a folder of its own, bit for bit, for all outputs of these passes that are
/// judged and that the first run has. `buffers`: what was read of the first run; null: nothing yet.
Races find_races(const capture::Pack& pack, const std::vector<std::filesystem::path>& runs, const std::vector<std::string>& passes,
                 const std::shared_ptr<ReadBuffers>& buffers = nullptr);

/// Makes each pass with a race fail; concludes anew.
void add_races(const std::vector<Race>& races, PortJudgement& judgement);

}  // namespace rainref::judge
