// Races: outputs of a port that differ between runs on the same inputs.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "capture/pack_read.h"
#include "judge/port_files.h"
#include "judge/verdict.h"

namespace rainref::judge {

/// An output that differs between two runs.
struct Race {
  std::string pass, id, output;
  int run = 0;  ///< the first run that differs from run 1; runs count from 1
  bool records = false;
  int x = 0, y = 0, channel = 0;       ///< first element that differs; for records, x is the record
  std::int64_t differing = 0, of = 0;  ///< channel values, or records, that differ in any run
  std::string text() const;
};

/// Results of comparing the runs of a port.
struct Races {
  std::vector<Race> found;
  std::vector<FileFault> files;  ///< errors in the runs after the first; validate reports those of the first
};

/// Compares the outputs of several runs of a port, each in its own folder, bit for bit: all outputs of these passes that are judged and
/// that the first run has. `buffers`: buffers already read from the first run; null: none.
Races find_races(const capture::Pack& pack, const std::vector<std::filesystem::path>& runs, const std::vector<std::string>& passes,
                 const std::shared_ptr<ReadBuffers>& buffers = nullptr);

/// Makes each pass with a race fail, and updates the conclusions.
void add_races(const std::vector<Race>& races, PortJudgement& judgement);

}  // namespace rainref::judge
