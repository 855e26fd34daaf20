// Judging what a port gave for cases in memory: what rainref::Judgement and the handles of rainref.h hold.
#pragma once

#include <optional>
#include <string>

#include "judge/verdict.h"
#include "judging/case_list.h"
#include "rainref/executor.h"
#include "rainref/judging.h"
#include "reports/source.h"

namespace rainref::judging {

/// A judgement, the same in public words, and what its page shows: the outputs as they were when it was made.
struct Judged {
  judge::PortJudgement judged;
  reports::PageSource source;
  Verdict verdict;

  std::string text() const;
  std::string json() const;
  std::string html() const;
  std::string junit() const;
};
/// A judgement in public words.
Verdict verdict_of(const judge::PortJudgement& judged);

/// Judges every pass that anything was given for. Error(usage) for an unknown profile, Error(port_files) where nothing was given.
Judged judge_cases(const CaseList& cases, const JudgeOptions& options, const parallel::Executor& executor);

}  // namespace rainref::judging
