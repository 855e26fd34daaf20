// Judgements as text for a terminal or a log.
#pragma once

#include <string>

#include "conformance/validate.h"
#include "conformance/verdict.h"

namespace rainref::conformance {

/// One line for each pass, then what failed: where, what was accepted, the likely cause.
std::string report_text(const PortJudgement& judgement);
/// One line for each deviation that was not caught, or for each when `all`; then the counts.
std::string report_text(const MutationReport& report, bool all);

/// 0 for PASS and WARN, 1 for FAIL and UNTESTED; UNTESTED is forgiven when asked and something passed.
int exit_code(const PortJudgement& judgement, bool allow_untested);

}  // namespace rainref::conformance
