// Judgements as text for a terminal or a log.
#pragma once

#include <string>

#include "faults/mutate.h"
#include "judge/verdict.h"
#include "reports/figures.h"

namespace rainref::reports {

/// One line for each pass, then what failed: where, what was accepted, the likely cause, and how much is not shown. "codes
/// wide" is the median of accepted codes besides the first (ULP of floats), of the widest output; "99 %" is what 99 % of its
/// elements stay below. Sentences are broken at 120 columns; notes and the last line, which hold
/// paths, are not. `is_verbose`: below each line stands what else is known of the pass, PASS or not, and what of its text, by lines of
/// our source, no run takes.
std::string report_text(const judge::PortJudgement& judgement, bool is_verbose = false);
/// One line for each fault that was not caught, or for each when `all`; then the counts.
std::string report_text(const faults::MutationReport& report, bool all);

}  // namespace rainref::reports
