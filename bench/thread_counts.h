// The numbers of threads that rows are measured with.
#pragma once

#include <vector>

#include "rainref/executor.h"

namespace rainref::bench {

/// 1, 2, 4 ... and all that this process may use.
inline std::vector<int> thread_counts() {
  const int all = parallel::Executor().threads();
  std::vector<int> counts;
  for (int n = 1; n < all; n *= 2) counts.push_back(n);
  counts.push_back(all);
  return counts;
}

}  // namespace rainref::bench
