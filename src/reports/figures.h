// The numbers and texts of a judgement that all reports show.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "judge/verdict.h"

namespace rainref::reports {

/// Width of envelopes.
struct Width {
  double codes = 0;         ///< number of accepted codes besides the first; 4e9 and more: no bound
  bool is_vacuous = false;  ///< too wide to be useful, whatever the number of codes
  double value = -1;        ///< in the unit; negative: unknown
  std::string unit = "";
};
/// Median and 99th percentile of the widths of envelopes; for an output those of its widest quantity, if codes are not meaningful.
Width median_width(const judge::QuantityJudgement& quantity);
Width p99_width(const judge::QuantityJudgement& quantity);
Width median_width(const judge::OutputJudgement& output);
Width p99_width(const judge::OutputJudgement& output);

/// Strength of a verdict: sums over outputs and cases, and the widest median and 99th percentile among them.
struct Figures {
  std::int64_t invocations = 0, failing = 0, ambiguous = 0, other_branch = 0, gave_up = 0;
  std::int64_t elements = 0, outside = 0, differing = 0, vacuous = 0, loose = 0, atypical = 0, free = 0;
  std::int64_t typical = 0, unbounded = 0, rearranged = 0, unsampled = 0;
  Width median_width, p99_width;

  /// Number of elements whose bound was needed.
  std::int64_t judged() const { return elements - free; }
  /// Number of elements in the sample, from which shares and widths are computed.
  std::int64_t sampled() const { return judged() - unsampled; }
  std::int64_t bounded() const { return sampled() - vacuous; }
};
Figures figures_of(const judge::OutputJudgement& output);
Figures figures_of(const judge::CaseJudgement& c);
Figures figures_of(const judge::PassJudgement& pass);

/// A share that is never rounded to all or to nothing: "0 %", "0.01 %", "99.99 %", "100 %"; "-" if `of` is 0.
std::string share_text(std::int64_t part, std::int64_t of);
/// A number and its unit: "0.0021 m"; for a pure number only the number.
std::string quantity_text(double value, const std::string& unit);
/// A width of the quantity in its unit, or "vacuous".
std::string in_unit(const Width& width);
/// "11 codes"; "0.0021 m" if codes are not meaningful, because there are two thousand million floats between -0.001 and 0.001; "vacuous".
std::string width_text(const Width& width);
/// "rgba16f 35x21", "6 records".
std::string shape_text(const judge::OutputJudgement& output);
/// "elements", "fields" or "records": the unit of its counts.
const char* element_word(const judge::OutputJudgement& output);
/// "records" or "texels": the unit of a cause's counts.
const char* element_word(const judge::Cause& cause);
/// "x" to "w".
std::string channel_name(int channel);

/// A failure in words. `got`, `accepted` and `expected` hold value and bits; they are empty for a whole record.
struct FailureText {
  std::string place;  ///< "(12, 3).x", "record 4, amplitude", "record 4"
  std::string got, accepted, expected;
  std::string distance;    ///< "off by 3 codes (0.0029 m)", "is not a number", "is in one of the lists alone"
  std::string value = "";  ///< only the distance, "0.0029 m"; "" if there is none, or codes are the values
};
FailureText failure_text(const judge::OutputJudgement& output, const judge::Failure& failure);

/// The quantity that fails worst: by its distance relative to its declared range, then by its number of failures; null if none fails.
const judge::QuantityJudgement* worst_quantity(const judge::OutputJudgement& output);
/// Whether one output fails worse than another, by the same measure.
bool fails_worse(const judge::OutputJudgement& a, const judge::OutputJudgement& b);

/// Largest number of failing cases of a pass that are shown: the first one, and those with most failures.
inline constexpr std::size_t pictured_failures = 4;
/// An output that is shown in pictures or field by field.
struct Shown {
  const judge::CaseJudgement* c;
  const judge::OutputJudgement* output;
};
/// The outputs shown for a pass, in this order: failing cases, then the one of the others that differs most. A failing case shows the
/// failing outputs, worst first; another case shows all outputs.
std::vector<Shown> shown_of(const judge::PassJudgement& pass);
/// The quantities of one output over all cases of a pass: counts are sums, widths and distances the largest.
struct QuantitiesOfOutput {
  std::string output;
  judge::Counted counted = judge::Counted::values;
  std::vector<judge::QuantityJudgement> quantities;
};
std::vector<QuantitiesOfOutput> quantities_of(const judge::PassJudgement& pass);

/// "exercises 41 of 44 alternatives, 2 with a reason not; never: shade.pass.h, refract total reflection: const Vec3<N> bent = ...", with at
/// most `shown` of them; if 0, only their number. "" if nothing is counted.
std::string coverage_text(const judge::PassCoverage& coverage, std::size_t shown);
/// "likely cause: NAME: SENTENCE", or "may be: ..."; without these words if no cause was found, and only lines are said.
std::string cause_words(const judge::Cause& cause);
/// "likely cause: upside down: the buffer is stored from the bottom up (gives 400 of 400 failing texels bit for bit, comes near 400)".
/// `which`: a word for its texels.
std::string cause_text(const judge::Cause& cause, std::string_view which = "failing");
/// Position of a cause in the port's shader, in the form that editors read: "FILE:LINE: the line itself".
std::vector<std::string> line_texts(const judge::Cause& cause);
/// The first cause and its line, in a line: "likely cause: NAME: SENTENCE; FILE:LINE: TEXT"; "cause unknown"; "" if there is no failure, or
/// causes were not sought.
std::string first_cause_text(const judge::PassJudgement& pass);
/// "is outside the as-written envelope of puddle.shade.corrected/2", or the text for values that no known device gives, if only that fails.
std::string outside_text(const judge::PassJudgement& pass);

/// Whether a run of it fails for a separate reason, which is then the cause: a race, an input that differs from the output it comes from, a
/// uniform.
bool is_broken(const judge::PassJudgement& pass);
/// Whether it fails without a known cause.
bool has_unknown_cause(const judge::PassJudgement& pass);

/// Whether its sample fails so much that the rest of a run was not judged.
bool fails_by_sample(const judge::PassJudgement& pass);
/// "widths and shares are those of a sample of 65536 of 8294400 elements (--exhaustive computes all)", with a note if fails_by_sample(); ""
/// if all were computed.
std::string sample_text(const judge::PassJudgement& pass);
/// A sentence about the detected rounding of stores to half; "" if the pass stores no half or the profile determines it.
std::string half_text(const judge::PassJudgement& pass);

/// Passes that are NOT JUDGED, in the order of execution.
std::vector<std::string> not_judged(const judge::PortJudgement& judgement);
/// Whether UNTESTED and NOT JUDGED are no failure: this was requested, and something passed.
bool forgives_untested(const judge::PortJudgement& judgement, bool allow_untested);
/// 0 for PASS, WARN and KNOWN, 1 for FAIL and for UNTESTED that is not forgiven; higher if files cannot be used.
int exit_code(const judge::PortJudgement& judgement, bool allow_untested);

/// Number of passes with each status, worst first: "1 FAIL, 4 PASS".
std::string count_text(const judge::PortJudgement& judgement);

}  // namespace rainref::reports
