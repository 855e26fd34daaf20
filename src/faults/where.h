// Where a pass fails: one sentence when its failures share a place.
#pragma once

#include <string>

#include "faults/fault.h"
#include "judge/judge_pass.h"

namespace rainref::faults {

/// "only channel y of wave; only within 4 texels of a record of drops", or "". The rule stands in where.cpp.
std::string where_it_fails(const judge::FailedRun& failed);

}  // namespace rainref::faults
