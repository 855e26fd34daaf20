// What every report says of a judgement, in numbers and in words.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "judge/verdict.h"

namespace rainref::reports {

/// How much a verdict is worth: sums over outputs and cases, and the widest median and 99th percentile among them.
struct Figures {
  std::int64_t invocations = 0, failing = 0, ambiguous = 0, other_branch = 0, gave_up = 0;
  std::int64_t elements = 0, outside = 0, differing = 0, vacuous = 0, loose = 0, atypical = 0, free = 0;
  double median_width = 0, p99_width = 0;

  /// Elements that a bound was asked for.
  std::int64_t judged() const { return elements - free; }
  std::int64_t bounded() const { return judged() - vacuous; }
};
Figures figures_of(const judge::OutputJudgement& output);
Figures figures_of(const judge::CaseJudgement& c);
Figures figures_of(const judge::PassJudgement& pass);

/// A share that never rounds to all or to nothing: "0 %", "0.01 %", "99.99 %", "100 %"; "-" of nothing.
std::string share_text(std::int64_t part, std::int64_t of);
/// A width in codes: "0", "3113", or "none" where there is no bound.
std::string width_text(double codes);
/// "rgba16f 35x21", "6 records".
std::string shape_text(const judge::OutputJudgement& output);
/// "elements", "fields" or "records": what its counts count.
const char* element_word(const judge::OutputJudgement& output);
/// "records" or "texels": what a cause explains.
const char* element_word(const judge::Cause& cause);
/// "x" to "w".
std::string channel_name(int channel);

/// A failure in words. `got`, `accepted` and `expected` hold value and bits; they are empty for a whole record.
struct FailureText {
  std::string place;  ///< "(12, 3).x", "record 4, amplitude", "record 4"
  std::string got, accepted, expected;
  std::string distance;  ///< "off by 3 codes", "is not a number", "is in one of the lists alone"
};
FailureText failure_text(const judge::OutputJudgement& output, const judge::Failure& failure);

/// "likely cause", or "may be".
const char* cause_word(const judge::Cause& cause);
/// "likely cause: upside down: the buffer is stored from the bottom up (gives 400 of 400 failing texels bit for bit, comes near 400)".
std::string cause_text(const judge::Cause& cause);

/// Whether a run of it fails for a reason of its own, which is then the cause: a race, an input that is not the output it
/// comes from, a uniform.
bool is_broken(const judge::PassJudgement& pass);
/// Whether it fails and nothing says why.
bool has_unknown_cause(const judge::PassJudgement& pass);

/// How stores to half were found to round, as a sentence; "" where the pass stores no half or the profile settles it.
std::string half_text(const judge::PassJudgement& pass);

/// Whether UNTESTED is no failure: it was asked for, and something passed.
bool forgives_untested(const judge::PortJudgement& judgement, bool allow_untested);
/// 0 for PASS, WARN and KNOWN, 1 for FAIL and for UNTESTED that is not forgiven.
int exit_code(const judge::PortJudgement& judgement, bool allow_untested);

/// How many passes have each status, worst first: "1 FAIL, 4 PASS".
std::string count_text(const judge::PortJudgement& judgement);

}  // namespace rainref::reports
