// Judges a port's outputs for cases in memory. rainref::Judgement and handles of rainref.h hold the result.
#pragma once

#include <optional>
#include <string>

#include "judge/verdict.h"
#include "judging/case_list.h"
#include "rainref/executor.h"
#include "rainref/judging.h"
#include "reports/source.h"

namespace rainref::judging {

/// A judgement, its public form, and the data of its page: the outputs at the time of judging.
struct Judged {
  judge::PortJudgement judged;
  reports::PageSource source;
  Verdict verdict;

  std::string text() const;
  std::string json() const;
  std::string html() const;
  std::string junit() const;
};
/// Converts a judgement to its public form.
Verdict verdict_of(const judge::PortJudgement& judged);

/// Judges every pass that has outputs. Error(usage) for an unknown profile, Error(port_files) if there are no outputs.
Judged judge_cases(const CaseList& cases, const JudgeOptions& options, const parallel::Executor& executor);

}  // namespace rainref::judging
