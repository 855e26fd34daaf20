// Statuses: of a case from its counts, of a pass from its cases, of a port from its passes.
#pragma once

#include "judge/verdict.h"
#include "math/profile.h"

namespace rainref::judge {

/// Status and reason of a case from its counts under a profile. UNTESTED where less than half of the elements have a bound, by the
/// profile or by what known devices do; of a sample where that may be, within its margin.
void conclude(CaseJudgement& judgement, const enclosed::Profile& profile);
/// Whether a sample does not tell if less than half have one: the share lies within its margin of a half.
bool is_open_by_sample(const CaseJudgement& judgement);
/// Those of a pass from its cases. Its reason so far is a doubt about the rounding that was found, which warns.
/// What is counted is counted over all cases.
void conclude(PassJudgement& judgement, const enclosed::Profile& profile);
/// The status of the whole from its passes, and the first that is bad.
void conclude(PortJudgement& judgement);

/// Makes each WARN a FAIL, of cases, passes and the whole: the reasons say of what.
void fail_warnings(PortJudgement& judgement);

}  // namespace rainref::judge
