// From a pack and a port's files to a judgement.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "capture/pack_read.h"
#include "judge/judge_pass.h"
#include "judge/port_files.h"
#include "judge/sample.h"
#include "judge/verdict.h"
#include "port_dump/port_info.h"
#include "rainref/executor.h"

namespace rainref::judge {

struct ValidateOptions {
  std::string profile = "vulkan";
  std::vector<std::string> only;       ///< judge these passes alone; empty: all
  bool foreign_host = false;           ///< shadow: what the host chose otherwise than the scene is a note
  bool partial = false;                ///< a pass without any file of the port is not judged, and its files are not missing
  std::int64_t sample = least_sample;  ///< as JudgeOptions::sample, of each pass; 0: every envelope is asked
  const parallel::Executor* executor = nullptr;
  std::function<void(int done, int of)> progress;  ///< after each case; may be null
  Explain explain;                                 ///< asked about each pass that fails; may be null
  /// Keeps what is read of the port's files, for the caller too; null: as long as the judging takes.
  std::shared_ptr<ReadBuffers> buffers;

  bool wants(const std::string& pass) const { return only.empty() || std::find(only.begin(), only.end(), pass) != only.end(); }
};

/// Judges the outputs in `port`, laid out as the pack. Files that are missing or cannot be what they should be are in
/// PortJudgement::files; the cases that need them are not judged, all others are. Throws Error(port_files) when there is
/// nothing of the pack in the folder at all, and when the pack's expected outputs are not this version's; Error(usage) when
/// `port` or a file in it is the pack's own.
PortJudgement validate(const capture::Pack& pack, const std::filesystem::path& port, const ValidateOptions& options);

/// A judgement that says what a pack is of, and nothing of a port yet.
PortJudgement unjudged(const capture::Pack& pack, const std::string& profile);

/// What the port says of itself, for reports, and of its stores to binary16.
void describe_port(const port_dump::PortInfo& info, PortJudgement& judgement);
std::optional<HalfMode> declared_mode(const port_dump::PortInfo& port);

}  // namespace rainref::judge
