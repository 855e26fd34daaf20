// Judges all runs of each pass of a port, with one run in memory at a time.
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
  capture::PassCase c;                 ///< inputs of the pass; c.outputs: the reference's for them
  std::vector<capture::Array> stored;  ///< the port's outputs, in the order of c.outputs
  port_dump::KeptForms kept = {};      ///< what their forms leave open, in the same order; empty: nothing
  std::string broken;                  ///< why the run fails whatever its outputs are; "": no such reason
  std::string untested;                ///< why it cannot be judged; "": it can
  bool has_no_files = false;           ///< it cannot be judged because the port's files are missing or unusable
};

/// Run k of a pass, in the order of execution.
using LoadRun = std::function<PortRun(std::size_t k)>;
/// Called with each run before it is judged: checks c.outputs, or computes them. The model is null if no output is judged by envelope.
using SettleRun = std::function<void(PortRun&, const capture::PassModel*)>;

/// The most informative run of a failing pass, for the diagnosis. A mistake shows in the others too.
struct FailedRun {
  const capture::PackPass& pass;
  const PortRun& run;
  const capture::PassCase* before;  ///< the previous run of the same pass, settled; null: none
  Bind bind;                        ///< null if no output is judged by envelope
  const capture::PassModel* model;  ///< of the run; null if no output is judged by one
  const CaseJudgement& judgement;
  const PassJudgement& judged;  ///< with all runs of the pass
  HalfMode half_mode;           ///< the rounding that the pass was judged by
  const JudgeOptions& options;
  const FailedRun* other = nullptr;  ///< the next most informative failing run; null: none
  /// The elements give a WARN, not a FAIL; `judgement` counts them as failing. Only plain mistakes are tried, which limits the time.
  bool is_warned = false;
  /// The same run, judged by the other rounding of halves, if nothing else tells the port's; null: it is known.
  const FailedRun* otherwise = nullptr;
  const capture::TracedProgram* program = nullptr;           ///< the port's own, on this run; null: not available
  const capture::TracedListProgram* list_program = nullptr;  ///< the same of a pass that writes lists
};
/// Finds causes of the failures and their common property. The judge itself knows no mistakes: faults/diagnose.h does.
using Explain = std::function<Explanation(const FailedRun&)>;

struct PassRuns {
  std::size_t count = 0;
  std::int64_t invocations = 0;  ///< of all runs together, which share a sample; 0: each run has its own
  LoadRun load;
  SettleRun settle;
  std::function<void()> done_one;  ///< after each run; may be null
  Explain explain;                 ///< called for a pass that fails, or warns of elements; may be null
  /// A pass that a do-nothing port would pass is UNTESTED. `load` must then return c.outputs as `settle` leaves them.
  bool tries_null_ports = false;
  bool counts_coverage = false;  ///< computes PassJudgement::coverage
  /// The inputs are the port's own: if nothing can be computed from them, the run fails.
  bool takes_inputs_of_port = false;
};

/// A pass and the port's runs of it. `bind` may be null if no output is judged by envelope; keyed records are then judged by bits.
struct PassTask {
  const capture::PackPass* pass;
  Bind bind;
  PassRuns runs;
};
/// Binds and settles a run that can be judged. Returns its model, as bound() does. Sets run.untested if it cannot be judged after all: a
/// list has another length, or nothing can be computed from the port's inputs.
std::unique_ptr<capture::PassModel> prepare(const PassTask& task, PortRun& run);

/// Judges the passes of one port, in this order. All share one rounding of half stores. `voters`: other passes of the port, which a sample
/// tests for their rounding.
std::vector<PassJudgement> judge_passes(const std::vector<PassTask>& tasks, const JudgeOptions& options,
                                        const std::vector<PassTask>& voters = {});

}  // namespace rainref::judge
