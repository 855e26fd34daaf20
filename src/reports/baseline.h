// The known failures of a port, each with its reason. Only new failures then fail a run.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "capture/pack_read.h"
#include "judge/verdict.h"
#include "rainref/error.h"

namespace rainref::reports {

/// A TOML file. A table [PASS.OUTPUT] allows this output to fail in every case, [PASS.OUTPUT."CASE"] in this one (its id, as printed in
/// reports). Its only key, `reason`, says why.
class Baseline {
 public:
  /// Throws Error(io) if the file cannot be read. Throws Error(usage) with file, line and key for any other content: a missing or empty
  /// reason, another key.
  static Baseline read(const std::filesystem::path& file);
  static Baseline parse(std::string_view toml, const std::string& file);

  /// Throws Error(usage) with the nearest name if an entry names an unknown pass, output or case. Cases that fail for another reason than
  /// an output (CaseJudgement::broken) cannot be listed.
  void check(const std::vector<capture::PackPass>& passes, const std::vector<std::string>& ids) const;

  /// Marks listed failures as known and updates the statuses. An entry of a judged pass without a matching failure goes to `stale` and
  /// fails the run. If two entries match one failure, the one with a case is used.
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
