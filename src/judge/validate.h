// Judges a port's files against a pack.
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
  std::vector<std::string> only;       ///< judge only these passes; empty: all
  bool foreign_host = false;           ///< shadow: a host's choices that differ from the scene are notes
  std::vector<std::string> fused;      ///< passes that one shader computes: "ground_noise+shade"; see judge/fused.h
  bool partial = false;                ///< a pass without any file of the port is not judged, and its files are not reported as missing
  std::int64_t sample = least_sample;  ///< as JudgeOptions::sample, for each pass; 0: all envelopes are computed
  const parallel::Executor* executor = nullptr;
  std::function<void(int done, int of)> progress;  ///< after each case; may be null
  Explain explain;                                 ///< called for each failing pass; may be null
  /// Keeps what is read from the port's files, also for the caller; null: only while judging.
  std::shared_ptr<ReadBuffers> buffers;

  bool wants(const std::string& pass) const { return only.empty() || std::find(only.begin(), only.end(), pass) != only.end(); }
};

/// Judges the outputs in `port`, laid out as the pack. Missing or unusable files are listed in PortJudgement::files; cases that need them
/// are not judged, all others are. Throws Error(port_files) if the folder holds nothing of the pack, or if the pack's expected outputs are
/// not this version's; Error(usage) if `port` or a file in it is the pack's own.
PortJudgement validate(const capture::Pack& pack, const std::filesystem::path& port, const ValidateOptions& options);

/// A judgement with the pack's description only, and no results of a port yet.
PortJudgement unjudged(const capture::Pack& pack, const std::string& profile);

/// Adds the port's description of itself, and a note if its API has another profile than this judgement.
void describe_port(const port_dump::PortInfo& info, PortJudgement& judgement);
std::optional<HalfMode> declared_mode(const port_dump::PortInfo& port);

}  // namespace rainref::judge
