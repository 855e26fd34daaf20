// A judgement as JSON, for programs. docs/reports.md lists every key.
#pragma once

#include <string>

#include "judge/verdict.h"
#include "reports/source.h"

namespace rainref::reports {

/// The whole judgement, indented, with a newline at the end. Format "rainref.judgement", version 1; keys are only ever added. A number that
/// JSON cannot represent (infinity, NaN) is null beside its bits; text that is not UTF-8 gets U+FFFD. `exit_code` is that of the run;
/// `source` has the passes' sentences and inputs. Equal judgements give equal bytes.
std::string report_json(const judge::PortJudgement& judgement, int exit_code, const PageSource& source);

}  // namespace rainref::reports
