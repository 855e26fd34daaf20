// What a judgement says: of an element, an output, a pass, a whole port.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "rainref/error.h"
#include "rainref/image.h"

namespace rainref::judge {

enum class Status : std::uint8_t {
  pass,
  warn,      ///< inside what the profile allows, but outside what known devices do, or with an open question
  fail,      ///< an element outside, a NaN, a crash
  untested,  ///< nothing was judged, or too much of it was vacuous
  known,     ///< fails, and the baseline says why it may
  data,      ///< taken as it is, because no GPU can reproduce it: neither judged nor a failure
  /// The port gave no files that could be judged.
  not_judged
};
/// "PASS", "WARN", "FAIL", "UNTESTED", "KNOWN", "DATA", "NOT JUDGED".
const char* name(Status status);
/// The worse: fail over not judged over untested over known over warn over pass over data.
Status worse(Status a, Status b);

/// How a device rounds its stores to binary16, voted over all elements.
enum class HalfMode : std::uint8_t { rne, rtz, either };
const char* name(HalfMode mode);

/// An element that no alternative accepts. Codes are ordered codes (image/code_range.h); the range is that of the
/// alternative which comes nearest.
struct Failure {
  int x = 0, y = 0, channel = 0;
  std::int64_t got = 0, low = 0, high = 0, expected = 0;
  std::uint64_t distance = 0;  ///< codes between got and the range; the largest number for NaN
  bool not_a_number = false;
  bool got_is_negative_zero = false, expected_is_negative_zero = false;  ///< -0, whose code is that of +0
  /// Of a record, whose number or id is x: the first member that is wrong, "y" or "velocity.z", and what it holds. "": the
  /// record is in one of the lists alone.
  std::string field = "";
  FormatInfo::Kind field_kind = FormatInfo::uint32;
};

/// What an output's elements are.
enum class Counted : std::uint8_t {
  values,  ///< channels of texels
  texels,  ///< judged by bits
  fields,  ///< of keyed records
  records  ///< judged by bits
};
/// "values", "texels", "fields", "records".
const char* name(Counted counted);

/// What has one name and one unit in an output: a channel of its texels, or a field of its records.
struct QuantityJudgement {
  std::string name, unit;     ///< "x" to "w", or "velocity.y"; "1" is the unit of pure numbers
  double extent = 0;          ///< of its declared range, in its unit; 0: it has none
  std::int64_t elements = 0;  ///< of these `free` ones no bound was asked for
  std::int64_t failing = 0, vacuous = 0, loose = 0, free = 0;
  double median_codes = 0, p99_codes = 0;  ///< of its envelopes, as OutputJudgement::median_width
  double median_width = 0, p99_width = 0;  ///< the same in its unit
  double farthest = 0;                     ///< an element outside from what is accepted, in its unit; infinity where that has no end
  std::int64_t unsampled = 0;              ///< as OutputJudgement::unsampled

  /// Those whose widths were asked for; vacuous and loose ones are of these.
  std::int64_t sampled() const { return elements - free - unsampled; }
};

/// One output of a pass over one case.
struct OutputJudgement {
  std::string name;
  Format format = Format::r8;
  bool records = false;
  Counted counted = Counted::values;
  int width = 0, height = 0;  ///< of records their expected number and 1
  std::int64_t elements = 0;  ///< as `counted` says; of keyed lists the fields of every record in either list
  std::int64_t failing = 0;
  std::int64_t differing = 0;              ///< not the reference's bits
  std::int64_t vacuous = 0;                ///< envelope wider than 1/16 of the declared range; of a record's field of its own
  std::int64_t loose = 0;                  ///< wider than 1/256
  std::int64_t atypical = 0;               ///< inside the profile, as far as it bounds them, but outside what known devices do
  std::int64_t open = 0;                   ///< of invocations, where asked, that the profile leaves without a bound in some alternative
  std::int64_t beyond = 0;                 ///< of these: outside what the coarsest device may do (judge/beyond.h)
  std::int64_t typical = 0;                ///< of the vacuous: inside what known devices do, which bounds them
  std::int64_t unbounded = 0;              ///< of the vacuous: not bounded by that either, or not judged by it
  std::int64_t rearranged = 0;             ///< outside the formula as written, inside the rearrangements that the profile allows
  std::int64_t free = 0;                   ///< declared as not reproducible: held to a range of its own
  std::int64_t unsampled = 0;              ///< beside the sample: vacuous, loose, typical, unbounded and the widths are not of these
  std::string known;                       ///< why the baseline lets it fail; "": it does not
  double median_width = 0, p99_width = 0;  ///< of the accepted codes, in codes: 0 where one code is accepted
  /// The same of every rearrangement, of each 64th invocation; below 0 where the profile or the pass has none.
  double rearranged_median_width = -1, rearranged_p99_width = -1;
  std::vector<Failure> worst;  ///< in order of distance, then of place; at most max_failures
  static constexpr std::size_t max_failures = 100;
  /// For each texel 0 (equal), 1 (differs, inside), 2 (atypical or rearranged), 3 (outside), not_judged; row 0 first; of records that are
  /// judged where they stand one row. Empty for others.
  std::vector<std::uint8_t> map;
  static constexpr std::uint8_t not_judged = 4;
  /// In order of channels, or of fields without the id.
  std::vector<QuantityJudgement> quantities;

  /// Those whose envelopes were asked for widths and shares.
  std::int64_t sampled() const { return elements - free - unsampled; }
};

/// One case of a pass.
struct CaseJudgement {
  std::string id;
  Status status = Status::untested;
  std::string reason;   ///< why, where it is not a plain pass or fail
  bool broken = false;  ///< fails for `reason`, whatever its outputs are: a race, an input that is not the output it comes from
  std::int64_t invocations = 0;
  std::int64_t failing = 0;               ///< invocations that no alternative accepts
  std::int64_t ambiguous = 0;             ///< invocations with more than one alternative
  std::int64_t other_branch = 0;          ///< of these, accepted only by an alternative that is not the reference's
  std::int64_t gave_up = 0;               ///< invocations with too many alternatives
  std::int64_t rearranged = 0;            ///< invocations that only a rearrangement accepts
  std::uint64_t rearranged_distance = 0;  ///< how far their values lie from the formula as written, at most [codes]
  std::int64_t beyond = 0;                ///< of the failing: with elements that are OutputJudgement::beyond; 0 where these are few
  /// Of the failing: accepted, and near what the profile's own rearrangements give, if products of sums were multiplied out, which no
  /// compiler is seen to do.
  std::int64_t expanded = 0;
  /// One of so many invocations was drawn for what is said of widths and shares (judge/sample.h): ambiguous, other_branch, gave_up, and
  /// those of the outputs. 1: all were asked.
  std::int64_t stride = 1;
  double unbounded_margin = 0;  ///< as Sample::margin, of unbounded elements
  bool is_of_sample = false;    ///< so much of the sample fails that the rest was not judged: every count is of the sample
  std::int64_t with_bits = 0;   ///< how many of some hundreds of invocations short cuts find inside by this rounding
  std::int64_t undecided = 0;   ///< not asked about under this rounding of stores to binary16, which the other one settles
  std::vector<OutputJudgement> outputs;
};

/// A place in a port's shader that a cause points at.
struct ShaderLine {
  std::string file;
  int line = 0;
  std::string text;  ///< of the line, without the blanks around it; "" where the program does not carry its source
  int until = 0;     ///< where a step is missing: it belongs after `line` and not after this one. Else 0
  friend bool operator==(const ShaderLine&, const ShaderLine&) = default;
};

/// What would explain the failures of a pass.
struct Cause {
  std::string name, sentence;
  std::int64_t explained = 0;  ///< failing texels whose stored bits it gives exactly
  std::int64_t of = 0;         ///< failing texels replayed
  std::int64_t inside = 0;     ///< failing texels that it comes near: as near as the envelope is usually wide
  bool of_records = false;     ///< of a list: ids that are missing, too many, or wrong, in place of texels
  bool is_likely = false;      ///< it explains nearly all of them; otherwise it may be the cause
  /// Where it stands in the port's shader, where that is given: one line, or several where causes that give the same bits stand in several.
  std::vector<ShaderLine> lines = {};
};
/// Why a pass fails, and where.
struct Explanation {
  std::vector<Cause> causes;  ///< best first; empty: unknown
  std::string where = "";     ///< "only channel y of wave": what the failures share; "": nothing
};

/// What the pack's runs exercise of a pass text, whatever the port did.
struct PassCoverage {
  int taken = 0, alternatives = 0;  ///< as Exercise (coverage.h) names them; 0: its outputs are only given
  /// Those not taken for which no reason is known: "shade.pass.h, shade_corrected: clamp 2, below".
  std::vector<std::string> never;
  std::map<std::string, std::string> reasons{};  ///< of the others not taken
  bool is_sampled = false;                       ///< by a sample of the invocations: another one may take more
};

struct PassJudgement {
  std::string pass, formula;
  Status status = Status::untested;
  std::string reason;
  bool inputs_are_good = true;  ///< every pass before it, on which it depends, passed
  HalfMode half_mode = HalfMode::either;
  std::array<std::int64_t, 3> half_votes{};  ///< failing invocations under rne, rtz, either
  std::array<bool, 3> half_is_least{};       ///< of these only the least: not every invocation had to be asked
  bool half_mode_voted = false;
  /// It fails by each rounding and nothing of the port tells which is its own. Causes were sought under both: half_mode is that of the
  /// better.
  bool half_mode_is_open = false;
  std::vector<CaseJudgement> cases;
  std::vector<Cause> causes;  ///< best first; empty: unknown. Of a WARN the likely one alone
  bool causes_sought = true;  ///< false: nobody asked for causes
  std::string null_port;      ///< a port that does nothing and passes, which makes the pass UNTESTED: "zeros"; "": none
  std::string where = "";     ///< Explanation::where
  PassCoverage coverage;
};

/// A file of the port that is missing or cannot be used.
struct FileFault {
  ExitCode code = ExitCode::port_files;
  std::string pass, id, output;  ///< of the case, and the buffer that the file is to hold
  std::string text;              ///< the file, what was expected and what was found
};

struct PortJudgement {
  std::string pack, port, profile, effect, variant, scene;
  std::string api, device, driver;
  std::string command;  ///< that reproduces this
  Status status = Status::untested;
  std::string reason;
  std::string first_bad_pass;         ///< in the order of dataflow
  std::vector<PassJudgement> passes;  ///< in the order of execution
  std::vector<FileFault> files;       ///< in the order of execution; the cases that need them are not judged
  std::vector<std::string> notes;
  std::vector<std::string> stale;  ///< what the baseline lists and did not fail: each a sentence, each fails the run
};

}  // namespace rainref::judge
