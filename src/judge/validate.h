// From a pack and a port's files to a judgement.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "capture/pack_read.h"
#include "judge/judge_pass.h"
#include "judge/verdict.h"
#include "port_dump/port_info.h"
#include "rainref/executor.h"

namespace rainref::judge {

struct ValidateOptions {
  std::string profile = "vulkan";
  std::string only;  ///< judge this pass alone; "": all
  const parallel::Executor* executor = nullptr;
  std::function<void(int done, int of)> progress;  ///< after each case; may be null
  Explain explain;                                 ///< asked about each pass that fails; may be null
};

/// Judges the outputs in `port`, laid out as the pack. Throws Error(port_files) when files are missing or cannot be what
/// they should be, naming all of them, and when the pack's expected outputs are not this version's; Error(usage) when
/// `port` is the pack's own folder.
PortJudgement validate(const capture::Pack& pack, const std::filesystem::path& port, const ValidateOptions& options);

/// What the port says of itself, for reports, and of its stores to binary16.
void describe_port(const port_dump::PortInfo& info, PortJudgement& judgement);
std::optional<HalfMode> declared_mode(const port_dump::PortInfo& port);

}  // namespace rainref::judge
