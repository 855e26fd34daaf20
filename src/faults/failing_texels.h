// Texels of a run: those that fail, and some of many.
#pragma once

#include <vector>

#include "faults/fault.h"
#include "judge/verdict.h"

namespace rainref::faults {

/// Those that no alternative accepts, row by row.
std::vector<Texel> failing_texels(const judge::CaseJudgement& judgement);
/// At most so many of them, spread evenly.
std::vector<Texel> spread(const std::vector<Texel>& all, std::size_t most);

}  // namespace rainref::faults
