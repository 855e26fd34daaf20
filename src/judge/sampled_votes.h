// Tests a few invocations of a pass for the rounding of its half stores, if the pass itself is not judged.
#pragma once

#include "judge/half_votes.h"
#include "judge/judge.h"
#include "judge/judge_pass.h"

namespace rainref::judge {

/// HalfVotes of a pass from some hundreds of invocations of a few of its runs; the counts are of these. No modes if the pass is not
/// informative: no output of halves is judged by envelope, it rounds inside, or its runs cannot be judged. Equal counts if it fails under
/// both. PassRuns::settle is not called.
HalfVotes sampled_votes(PassTask task, const JudgeOptions& options);

}  // namespace rainref::judge
