// Arithmetic in registers alone.
#pragma once

#include <cstdint>

namespace rainref::bench {

/// Operations of a float each, of a round of chains().
int operations_of_round();
/// Rounds of products and sums of vectors, as wide as those of the passes; of several chains, so that none waits for the one before.
/// Returns a sum of what came of it.
float chains(std::int64_t rounds);

}  // namespace rainref::bench
