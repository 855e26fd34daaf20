// Statuses: of a case from its counts, of a pass from its cases, of a port from its passes.
#pragma once

#include "judge/verdict.h"
#include "math/profile.h"

namespace rainref::judge {

/// Sets status and reason of a case from its counts. UNTESTED if neither the profile nor the known devices bound half of the elements; with
/// a sample, if that is possible within its margin.
void conclude(CaseJudgement& judgement, const enclosed::Profile& profile);
/// True if the sample leaves this undecided: the share lies within its margin of a half.
bool is_open_by_sample(const CaseJudgement& judgement);
/// Sets status and reason of a pass from all its cases. A reason that is already set, a doubt about the rounding, makes it a WARN.
void conclude(PassJudgement& judgement, const enclosed::Profile& profile);
/// Sets the status of the port from its passes, and the first bad pass.
void conclude(PortJudgement& judgement);

/// Turns each WARN of cases, passes and the port into a FAIL; the reasons say so.
void fail_warnings(PortJudgement& judgement);

}  // namespace rainref::judge
