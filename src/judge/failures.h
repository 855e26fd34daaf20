// The failures that a report lists.
#pragma once

#include <vector>

#include "judge/slots.h"
#include "judge/verdict.h"

namespace rainref::judge {

/// Sorts by distance, then by place, and keeps at most OutputJudgement::max_failures.
void keep_worst(std::vector<Failure>& worst);

/// A value that no alternative holds; `accepted`: the nearest codes, null if there are none.
Failure failure_of(const Slot& slot, int x, int y, const capture::Array& want, const capture::Array& have,
                   const enclosed::CodeRange* accepted);

}  // namespace rainref::judge
