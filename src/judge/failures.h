// The failures that a report shows.
#pragma once

#include <vector>

#include "judge/slots.h"
#include "judge/verdict.h"

namespace rainref::judge {

/// In order of distance, then of place; at most OutputJudgement::max_failures.
void keep_worst(std::vector<Failure>& worst);

/// A value that the alternatives of `accepted` do not hold; `accepted`: the codes that come nearest, null where there are none.
Failure failure_of(const Slot& slot, int x, int y, const capture::Array& want, const capture::Array& have,
                   const enclosed::CodeRange* accepted);

}  // namespace rainref::judge
