// Judging every run of each pass that a port made, one run in memory at a time.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "capture/pack_read.h"
#include "capture/traced_program.h"
#include "judge/evaluations.h"
#include "judge/judge.h"
#include "judge/verdict.h"

namespace rainref::judge {

/// A run of a pass by a port.
struct PortRun {
  capture::PassCase c;                 ///< what the pass took; c.outputs: what the reference gives for it
  std::vector<capture::Array> stored;  ///< what the port gave, in the order of c.outputs
  std::string broken;                  ///< why the run fails whatever its outputs are; "": it does not
  std::string untested;                ///< why it cannot be judged; "": it can
  bool has_no_files = false;           ///< it cannot be judged because the port's files are missing or cannot be used
};

/// Run k of a pass, in the order of execution.
using LoadRun = std::function<PortRun(std::size_t k)>;
/// Called with each run before it is judged, with the pass's model, or null where no output is judged by envelope:
/// checks c.outputs, or computes them.
using SettleRun = std::function<void(PortRun&, const capture::PassModel*)>;

/// The run of a failing pass that says most, for those who ask why it fails. A mistake shows in the others too.
struct FailedRun {
  const capture::PackPass& pass;
  const PortRun& run;
  const capture::PassCase* before;  ///< the run of the same pass before it, settled; null: none
  Bind bind;                        ///< null where no output is judged by envelope
  const capture::PassModel* model;  ///< of the run; null where no output is judged by one
  const CaseJudgement& judgement;
  const PassJudgement& judged;  ///< with all runs of the pass
  HalfMode half_mode;           ///< that the pass was judged by
  const JudgeOptions& options;
  const FailedRun* other = nullptr;  ///< the failing run that says next most; null: none
  double share = 1;                  ///< of the time that there is for its pass, which is asked about under each rounding of halves
  /// What is asked about is warned of and does not fail: `judgement` has it as failing. What is plain is tried alone, which bounds the
  /// time.
  bool is_warned = false;
  const capture::TracedProgram* program = nullptr;  ///< the port's own, on this run; null: it is not at hand
};
/// What would explain its failures, and what they share. The judge itself knows no mistakes: faults/diagnose.h does.
using Explain = std::function<Explanation(const FailedRun&)>;

struct PassRuns {
  std::size_t count = 0;
  std::int64_t invocations = 0;  ///< of all runs together, which share a sample; 0: each has its own
  LoadRun load;
  SettleRun settle;
  std::function<void()> done_one;  ///< after each run; may be null
  Explain explain;                 ///< asked about a pass that fails, or warns of elements; may be null
  /// A pass that a port passes which does nothing is UNTESTED. What `settle` leaves of c.outputs is then what `load` gives.
  bool tries_null_ports = false;
  bool counts_coverage = false;  ///< PassJudgement::coverage is wanted
  /// What a run takes is the port's own: where nothing can be computed with it, the run fails.
  bool takes_inputs_of_port = false;
};

/// A pass and what the port has of it. `bind` may be null when no output of the pass is judged by envelope; keyed records
/// are then judged by bits.
struct PassTask {
  const capture::PackPass* pass;
  Bind bind;
  PassRuns runs;
};
/// Binds and settles a run that can be judged. Its model, as bound() gives it. run.untested says why it cannot be judged after all: a list
/// has another length, or nothing can be computed with what the port took.
std::unique_ptr<capture::PassModel> prepare(const PassTask& task, PortRun& run);

/// The passes of one port, in this order. How its stores to binary16 round is one choice for all of them. `voters`: other passes of it,
/// which are asked by a sample how stores round.
std::vector<PassJudgement> judge_passes(const std::vector<PassTask>& tasks, const JudgeOptions& options,
                                        const std::vector<PassTask>& voters = {});

}  // namespace rainref::judge
