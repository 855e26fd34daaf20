// Statuses: of a case from its counts, of a pass from its cases, of a port from its passes.
#pragma once

#include "judge/verdict.h"

namespace rainref::judge {

/// Status and reason of a case from its counts.
void conclude(CaseJudgement& judgement);
/// Those of a pass from its cases. Its reason so far is a doubt about the rounding that was found, which warns.
void conclude(PassJudgement& judgement);
/// The status of the whole from its passes, and the first that is bad.
void conclude(PortJudgement& judgement);

}  // namespace rainref::judge
