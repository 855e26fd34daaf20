// Judgements as text for a terminal or a log.
#pragma once

#include <string>

#include "faults/mutate.h"
#include "judge/verdict.h"
#include "reports/figures.h"

namespace rainref::reports {

/// One line for each pass, then the failures: place, accepted values, likely cause, and the number not shown. "codes wide" is the median of
/// accepted codes besides the first (ULP of floats), of the widest output; "99 %" is the 99th percentile of its elements. Sentences are
/// wrapped at 120 columns; notes and the last line, which contain paths, are not. `is_verbose`: below each line is more information about
/// the pass, PASS or not, and the lines of its text whose alternatives no run takes.
std::string report_text(const judge::PortJudgement& judgement, bool is_verbose = false);
/// One line for each fault that was not caught, or for each when `all`; then the counts.
std::string report_text(const faults::MutationReport& report, bool all);

}  // namespace rainref::reports
