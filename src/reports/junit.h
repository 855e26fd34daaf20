// A judgement as JUnit XML, for continuous integration.
#pragma once

#include <map>
#include <string>

#include "judge/verdict.h"

namespace rainref::reports {

/// Seconds that judging took.
struct Times {
  std::map<std::string, double> cases;   ///< by the case's id; empty: not measured
  std::map<std::string, double> causes;  ///< by the pass: the search for why it fails
};

/// A testsuite for each pass, a testcase for each case and output, in the dialect that Jenkins and GitLab read. A file has a failure or an
/// error exactly when exit_code is not 0:
///   FAIL      failure, with the worst elements and the likely causes as its text
///   KNOWN     skipped, with the baseline's reason
///   UNTESTED  failure, or skipped if it is forgiven
///   WARN      passes, with the reason in system-out
/// An entry of the baseline that no longer fails is a failure in a testsuite "baseline". A judgement without passes is an error with its
/// reason. No host: equal judgements with equal times give equal bytes. With `times` a test has its share of its case's, and a testsuite
/// all of its pass, the search for causes included.
std::string report_junit(const judge::PortJudgement& judgement, bool allow_untested, const Times& times = {});

}  // namespace rainref::reports
