// Judges outputs by envelope: compares each invocation with all results that the profile allows.
#pragma once

#include <vector>

#include "capture/pass_model.h"
#include "judge/judge.h"

namespace rainref::judge {

/// Judges the port's outputs that are is_placed(), once for each rounding of half stores; other outputs get no counts. `port` as in
/// judge_case. Throws Error(internal) if the model does not fit the outputs. Outside of the sample (JudgeOptions), no envelope is computed
/// for values with the reference's bits.
std::vector<CaseJudgement> judge_envelopes(const capture::PassCase& c, const capture::PassModel& model,
                                           const std::vector<capture::Array>& port, const JudgeOptions& options,
                                           const std::vector<HalfMode>& modes);

}  // namespace rainref::judge
