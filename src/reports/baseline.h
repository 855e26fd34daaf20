// The failures of a port that are known, each with its reason, so that only new ones fail a run.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "capture/pack_read.h"
#include "judge/verdict.h"
#include "rainref/error.h"

namespace rainref::reports {

/// A TOML file: a table [PASS.OUTPUT] lets this output fail in every case, [PASS.OUTPUT."CASE"] in this one (its id, as
/// reports print it); its one key, `reason`, says why.
class Baseline {
 public:
  /// Throws Error(io) when the file cannot be read, Error(usage) with file, line and key for anything but the above: a
  /// missing or empty reason, another key.
  static Baseline read(const std::filesystem::path& file);
  static Baseline parse(std::string_view toml, const std::string& file);

  /// Throws Error(usage) with the nearest name where an entry names a pass, an output or a case that is not among these. What
  /// is broken for another reason than an output (CaseJudgement::broken) cannot be listed.
  void check(const std::vector<capture::PackPass>& passes, const std::vector<std::string>& ids) const;

  /// Marks listed failures as known and settles the statuses anew. An entry of a judged pass that let nothing fail goes
  /// to `stale` and fails the run. Of two entries for one failure the one with a case counts.
  void apply(judge::PortJudgement& judgement) const;

 private:
  struct Entry {
    std::string pass, output, id;  ///< id: "" for every case
    std::string reason;
    SourceLocation at;
    std::string text() const;  ///< "[shade.colour]"
  };
  std::vector<Entry> entries_;
};

}  // namespace rainref::reports
