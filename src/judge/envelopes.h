// Judging outputs by envelope: each invocation against every result that the profile allows, counted.
#pragma once

#include <vector>

#include "capture/pass_model.h"
#include "judge/judge.h"

namespace rainref::judge {

/// What a port stored in the case's outputs of is_placed(), one judgement for each rounding of half stores; in its
/// `outputs` those that are judged otherwise have no counts. `port` as in judge_case. Throws Error(internal) where the model
/// is not that of the outputs. Outside of the sample (JudgeOptions) no envelope is asked of what has the reference's bits.
std::vector<CaseJudgement> judge_envelopes(const capture::PassCase& c, const capture::PassModel& model,
                                           const std::vector<capture::Array>& port, const JudgeOptions& options,
                                           const std::vector<HalfMode>& modes);

}  // namespace rainref::judge
