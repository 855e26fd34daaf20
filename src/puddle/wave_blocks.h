// The wave steps of a frame.
#pragma once

#include <span>

#include "puddle/kernels.h"
#include "rainref/executor.h"

namespace rainref::puddle {

/// Steps one after another over the whole wave. The two levels take turns: what is `newest` in one job is `previous` in the next.
/// Several steps have the bits of each alone and take less time: rows go through all of them while they lie in a cache.
void step_wave(std::span<const WaveJob> jobs, const parallel::Executor& executor);

}  // namespace rainref::puddle
