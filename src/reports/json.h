// A judgement as JSON, for programs. docs/reports.md lists every key.
#pragma once

#include <string>

#include "judge/verdict.h"
#include "reports/source.h"

namespace rainref::reports {

/// Everything that the judgement holds, indented, ends with a newline. Format "rainref.judgement", version 1; keys are
/// only ever added. A number that JSON cannot hold (infinity, NaN) is null beside its bits; text that is no UTF-8 gets
/// U+FFFD. `exit_code` is that of the run; `source` has the passes' sentences and what they take. Equal judgements give equal
/// bytes.
std::string report_json(const judge::PortJudgement& judgement, int exit_code, const PageSource& source);

}  // namespace rainref::reports
