// Races: outputs of a port that differ between runs on the same inputs.
#pragma once

#include <filesystem>
#include <vector>

#include "capture/pack_read.h"
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

/// Compares what runs of a port wrote, each in a folder of its own, bit for bit, for all outputs that are judged. Throws
/// Error(port_files) as validate does.
std::vector<Race> find_races(const capture::Pack& pack, const std::vector<std::filesystem::path>& runs, const std::string& only);

/// Makes each pass with a race fail; concludes anew.
void add_races(const std::vector<Race>& races, PortJudgement& judgement);

}  // namespace rainref::judge
