// How a pass that is not judged itself tells the rounding of stores to binary16: a few of its invocations are asked.
#pragma once

#include "judge/half_votes.h"
#include "judge/judge.h"
#include "judge/judge_pass.h"

namespace rainref::judge {

/// What HalfVotes says of a pass, by some hundreds of invocations of a few of its runs; its counts are theirs. No modes where the pass
/// tells nothing: it has no output of halves that an envelope judges, it rounds inside, or its runs cannot be judged. Equal counts where it
/// fails by both. PassRuns::settle is not called.
HalfVotes sampled_votes(PassTask task, const JudgeOptions& options);

}  // namespace rainref::judge
