// A judgement as annotations of GitHub's actions: messages at the lines of a port's shader.
#pragma once

#include <string>

#include "judge/verdict.h"

namespace rainref::reports {

/// A line "::error file=shade.comp,line=57,title=rainref: shade::MESSAGE" for each pass that fails, with its first cause; at the first line
/// of that cause in the port's shader, if there is one. "::warning" for a WARN. There is an error exactly when exit_code is not 0. Text
/// from ports and packs is escaped, so that it begins no other command.
std::string report_annotations(const judge::PortJudgement& judgement, bool allow_untested);

}  // namespace rainref::reports
