// How long judging took, case by case, from the calls that it makes.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "capture/pass_clock.h"
#include "judge/verdict.h"
#include "reports/junit.h"

namespace rainref::cli {

/// Construct it when judging begins.
class JudgingTimes {
 public:
  /// A case is judged; they come in the order of the judgement's.
  void end_case();
  /// The search for the causes of a pass begins; it lasts until the next one, or until judging is over.
  void begin_causes(const std::string& pass);
  /// Call when judging is over.
  void end();
  reports::Times of(const judge::PortJudgement& judgement) const;

 private:
  double lap();

  capture::Stopwatch watch_;
  double last_ = 0;
  std::vector<double> cases_;
  std::vector<std::pair<std::string, double>> causes_;
};

}  // namespace rainref::cli
