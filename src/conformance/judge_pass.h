// Judging every run of each pass that a port made, one run in memory at a time.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "conformance/deviations.h"
#include "conformance/judge.h"
#include "conformance/verdict.h"

namespace rainref::conformance {

/// A run of a pass by a port.
struct PortRun {
  capture::PassCase c;                 ///< what the pass took; c.outputs: what the reference gives for it
  std::vector<capture::Array> stored;  ///< what the port gave, in the order of c.outputs
  std::string broken;                  ///< why the run fails whatever its outputs are; "": it does not
  std::string untested;                ///< why it cannot be judged; "": it can
};

/// Run k of a pass, in the order of execution.
using LoadRun = std::function<PortRun(std::size_t k)>;
/// Called with each run before it is judged, with the pass's model, or null where no output is judged by envelope:
/// checks c.outputs, or computes them.
using SettleRun = std::function<void(PortRun&, const capture::PassModel*)>;

struct PassRuns {
  std::size_t count = 0;
  LoadRun load;
  SettleRun settle;
  std::function<void()> done_one;  ///< after each run; may be null
  bool diagnose = true;
};

/// A pass and what the port has of it. `bind` may be null when no output of the pass is judged by envelope; keyed records
/// are then judged by bits.
struct PassTask {
  const capture::PackPass* pass;
  Bind bind;
  PassRuns runs;
};
/// The passes of one port, in this order. How its stores to binary16 round is one choice for all of them.
std::vector<PassJudgement> judge_passes(const std::vector<PassTask>& tasks, const JudgeOptions& options);

/// Whether an output is judged by envelope.
bool is_enveloped(const capture::PassCase& c);
/// The model of a run; null where no output is judged by one. Throws Error(internal) when it needs one and there is no
/// `bind`, and what `bind` throws.
std::unique_ptr<capture::PassModel> bound(const std::string& pass, Bind bind, const capture::PassCase& c);

}  // namespace rainref::conformance
