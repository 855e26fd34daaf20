// Judges one run of a pass: compares each invocation's stored values with every result that the profile allows.
#pragma once

#include <optional>
#include <vector>

#include "capture/pass_model.h"
#include "judge/verdict.h"
#include "math/profile.h"
#include "port_dump/kept.h"
#include "rainref/executor.h"

namespace rainref::judge {

struct JudgeOptions {
  const enclosed::Profile* profile;
  const enclosed::Profile* typical = nullptr;  ///< null: nothing warns
  const parallel::Executor* executor;
  std::optional<HalfMode> half_mode;  ///< declared by the port
  /// The least number of invocations of a run (judge_passes: of all runs of a pass) whose envelopes are computed for widths and shares
  /// (judge/sample.h). Other invocations get an envelope only if they lack the reference's bits. 0: all envelopes.
  std::int64_t sample = 0;
  /// What the port's own forms of the outputs leave open, in the order of c.outputs; null: nothing. Of one run.
  const port_dump::KeptForms* kept = nullptr;
  /// False: what one rounding of half stores accepts is not tested under the others; CaseJudgement::undecided counts it.
  bool every_rounding = false;
};

/// Rounding of half stores that a profile requires.
HalfMode half_mode_of(const enclosed::Profile& profile);

/// Returns the possible roundings of half stores. If the profile leaves it open: rne, rtz and either, or the one that the port declares. If
/// it requires one: that one, then the other, because not all drivers obey; only the required one if the port declares it. One if a case
/// has no halves that an envelope judges.
std::vector<HalfMode> modes_of(const capture::PassCase& c, const JudgeOptions& options);

/// The judgement for each of modes_of().
struct ModeJudgements {
  std::vector<HalfMode> modes;
  std::vector<CaseJudgement> judgements;  ///< one for each mode
  bool rounds_inside = false;             ///< the pass also rounds between its operations (PassModel::rounds_inside)
};

/// Judges what a port stored. `port` holds its outputs in the order of c.outputs, with the same format and size; lists of records without
/// ids have the same length. Outputs of Judge::bits must equal the expected bits; those of Judge::input_only are not judged. `model` may be
/// null if no output is judged by envelope. c.outputs must be the reference's: judge_passes' settle ensures it.
///
/// A sample gives the same verdict as all invocations, unless the share without a bound lies within the sample's margin of its limit: then
/// all are tested. The reference's own outputs never fail, because every envelope holds the reference.
ModeJudgements judge_case(const capture::PassCase& c, const capture::PassModel* model, const std::vector<capture::Array>& port,
                          const JudgeOptions& options);

}  // namespace rainref::judge
