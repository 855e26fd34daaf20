// A judgement as Markdown, for the summary of a job in continuous integration.
#pragma once

#include <string>

#include "judge/verdict.h"

namespace rainref::reports {

/// The verdict as a heading, a table with a row for each pass and its first cause, and report_text() to unfold; in GitHub's Markdown, which
/// GitLab reads too. Text from ports and packs is shown as it is and formats nothing. Equal judgements give equal bytes.
std::string report_markdown(const judge::PortJudgement& judgement);

}  // namespace rainref::reports
