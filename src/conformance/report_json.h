// A judgement as JSON, for programs. docs/reports.md lists every key.
#pragma once

#include <string>

#include "conformance/verdict.h"

namespace rainref::conformance {

/// Everything that the judgement holds, indented, ends with a newline. Format "rainref.judgement", version 1; keys are
/// only ever added. A number that JSON cannot hold (infinity, NaN) is null beside its bits; text that is no UTF-8 gets
/// U+FFFD. `exit_code` is that of the run. Equal judgements give equal bytes.
std::string report_json(const PortJudgement& judgement, int exit_code);

}  // namespace rainref::conformance
