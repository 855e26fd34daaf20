// Judging one run of a pass: each invocation's stored values against every result that the profile allows.
#pragma once

#include <optional>
#include <vector>

#include "capture/pass_model.h"
#include "judge/verdict.h"
#include "math/profile.h"
#include "rainref/executor.h"

namespace rainref::judge {

struct JudgeOptions {
  const enclosed::Profile* profile;
  const enclosed::Profile* typical = nullptr;  ///< null: nothing warns
  const parallel::Executor* executor;
  std::optional<HalfMode> half_mode;  ///< declared by the port
  /// Invocations of a run (judge_passes: of all runs of a pass) that are asked at least for widths and shares (judge/sample.h). Of the
  /// others only what has not the reference's bits is asked for its envelope. 0: each is asked.
  std::int64_t sample = 0;
  /// Whether what one rounding of stores to binary16 settles is asked under the others too: else CaseJudgement::undecided counts it.
  bool every_rounding = false;
};

/// What a profile asks of stores to binary16.
HalfMode half_mode_of(const enclosed::Profile& profile);

/// The ways in which stores to binary16 may have been rounded. Where the profile leaves it open these are rne, rtz and either, or the one
/// that the port declares. Where it asks for one, that one and then the other, because drivers do not all obey; only that one where the
/// port declares the same. One where a case has no halves that an envelope judges.
std::vector<HalfMode> modes_of(const capture::PassCase& c, const JudgeOptions& options);

/// Each of modes_of(), judged.
struct ModeJudgements {
  std::vector<HalfMode> modes;
  std::vector<CaseJudgement> judgements;  ///< one for each mode
  bool rounds_inside = false;             ///< the pass rounds between its operations, too (PassModel::rounds_inside)
};

/// Judges what a port stored: `port` holds its outputs in the order of c.outputs, of the same format and size, lists of records whose
/// key is their place too. Outputs
/// of Judge::bits must equal the expected bits, those of Judge::input_only are not judged. `model` may be null when no
/// output is judged by envelope. c.outputs must be what the reference gives: judge_passes' settle sees to it.
///
/// A sample gives the verdict of all, but where the share without a bound lies within the sample's margin of its limit: then all are asked.
/// With the reference's own outputs as `port` nothing ever fails: every envelope holds the reference.
ModeJudgements judge_case(const capture::PassCase& c, const capture::PassModel* model, const std::vector<capture::Array>& port,
                          const JudgeOptions& options);

}  // namespace rainref::judge
