#include "cli/judging_times.h"

namespace rainref::cli {

double JudgingTimes::lap() {
  const double now = watch_.seconds();
  return now - std::exchange(last_, now);
}

void JudgingTimes::end_case() { cases_.push_back(lap()); }

void JudgingTimes::end() {
  const double seconds = lap();
  if (!causes_.empty()) causes_.back().second += seconds;
}

void JudgingTimes::begin_causes(const std::string& pass) {
  end();
  causes_.emplace_back(pass, 0);
}

reports::Times JudgingTimes::of(const judge::PortJudgement& judgement) const {
  reports::Times times;
  std::size_t k = 0;
  for (const judge::PassJudgement& p : judgement.passes)
    for (const judge::CaseJudgement& c : p.cases) times.cases[c.id] = k < cases_.size() ? cases_[k++] : 0;
  for (const auto& [pass, seconds] : causes_) times.causes[pass] += seconds;
  return times;
}

}  // namespace rainref::cli
