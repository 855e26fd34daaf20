// Results of judging: an element, an output, a pass, a whole port.
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
  warn,      ///< inside the profile, but outside what known devices do, or with an open question
  fail,      ///< an element outside, a NaN, a crash
  untested,  ///< nothing was judged, or too much of it was vacuous
  known,     ///< fails, but the baseline permits it and says why
  data,      ///< taken as it is, because no GPU can reproduce it: not judged, not a failure
  /// The port gave no usable files.
  not_judged
};
/// "PASS", "WARN", "FAIL", "UNTESTED", "KNOWN", "DATA", "NOT JUDGED".
const char* name(Status status);
/// Returns the worse: fail over not judged over untested over known over warn over pass over data.
Status worse(Status a, Status b);

/// How a device rounds its stores to binary16, by a vote of all elements.
enum class HalfMode : std::uint8_t { rne, rtz, either };
const char* name(HalfMode mode);

/// An element that no alternative accepts. Codes are ordered codes (image/code_range.h); the range is that of the nearest alternative.
struct Failure {
  int x = 0, y = 0, channel = 0;
  std::int64_t got = 0, low = 0, high = 0, expected = 0;
  std::uint64_t distance = 0;  ///< codes between `got` and the range; the largest number for NaN
  bool not_a_number = false;
  bool got_is_negative_zero = false, expected_is_negative_zero = false;  ///< -0, whose code is that of +0
  /// For a record, whose index or id is x: the first wrong member, "y" or "velocity.z", and its value. "": the record is in only one of the
  /// lists.
  std::string field = "";
  FormatInfo::Kind field_kind = FormatInfo::uint32;
};

/// What the elements of an output are.
enum class Counted : std::uint8_t {
  values,  ///< channels of texels
  texels,  ///< judged by bits
  fields,  ///< of keyed records
  records  ///< judged by bits
};
/// "values", "texels", "fields", "records".
const char* name(Counted counted);

/// Counts for one name and unit in an output: a channel of its texels, or a field of its records.
struct QuantityJudgement {
  std::string name, unit;     ///< "x" to "w", or "velocity.y"; "1" is the unit of pure numbers
  double extent = 0;          ///< of its declared range, in its unit; 0: none
  std::int64_t elements = 0;  ///< of these, `free` were not bounded
  std::int64_t failing = 0, vacuous = 0, loose = 0, free = 0;
  double median_codes = 0, p99_codes = 0;  ///< width of the envelopes, as OutputJudgement::median_width
  double median_width = 0, p99_width = 0;  ///< the same in its unit
  double farthest = 0;         ///< largest distance of an outside element from the accepted range, in its unit; infinity if there is no end
  std::int64_t unsampled = 0;  ///< as OutputJudgement::unsampled

  /// Elements with a known width; vacuous and loose ones are among these.
  std::int64_t sampled() const { return elements - free - unsampled; }
};

/// One output of a pass over one case.
struct OutputJudgement {
  std::string name;
  Format format = Format::r8;
  bool records = false;
  Counted counted = Counted::values;
  int width = 0, height = 0;  ///< for records: their expected number, and 1
  std::int64_t elements = 0;  ///< in the unit of `counted`; for keyed lists the fields of every record in either list
  std::int64_t failing = 0;
  std::int64_t differing = 0;              ///< without the reference's bits
  std::int64_t vacuous = 0;                ///< envelope wider than 1/16 of the declared range; for a record, of the field's own range
  std::int64_t loose = 0;                  ///< wider than 1/256
  std::int64_t atypical = 0;               ///< inside the profile where it has bounds, but outside what known devices do
  std::int64_t open = 0;                   ///< of tested invocations: the profile leaves them without a bound in some alternative
  std::int64_t beyond = 0;                 ///< of the open: outside what the coarsest device may do (judge/beyond.h)
  std::int64_t typical = 0;                ///< of the vacuous: inside what known devices do, which bounds them
  std::int64_t unbounded = 0;              ///< of the vacuous: not bounded by known devices either, or not tested against them
  std::int64_t rearranged = 0;             ///< outside the formula as written, inside the rearrangements that the profile allows
  std::int64_t free = 0;                   ///< declared as not reproducible: only checked against its own range
  std::int64_t unsampled = 0;              ///< outside the sample: not counted in vacuous, loose, typical, unbounded and the widths
  std::string known;                       ///< why the baseline permits its failure; "": it does not
  double median_width = 0, p99_width = 0;  ///< accepted codes besides the first: 0 if one code is accepted
  /// The same for all rearrangements, over every 64th invocation; below 0 if the profile or the pass has none.
  double rearranged_median_width = -1, rearranged_p99_width = -1;
  std::vector<Failure> worst;  ///< in order of distance, then of place; at most max_failures
  static constexpr std::size_t max_failures = 100;
  /// For each texel 0 (equal), 1 (differs, inside), 2 (atypical or rearranged), 3 (outside), not_judged; row 0 first. Records that are
  /// judged at their place are one row. Empty for other records.
  std::vector<std::uint8_t> map;
  static constexpr std::uint8_t not_judged = 4;
  /// In order of channels, or of fields without the id.
  std::vector<QuantityJudgement> quantities;

  /// Elements whose envelopes were computed for widths and shares.
  std::int64_t sampled() const { return elements - free - unsampled; }
};

/// One case of a pass.
struct CaseJudgement {
  std::string id;
  Status status = Status::untested;
  std::string reason;   ///< explains a status that is not a plain pass or fail
  bool broken = false;  ///< fails for `reason`, whatever its outputs are: a race, or an input that is not its source's output
  std::int64_t invocations = 0;
  std::int64_t failing = 0;               ///< invocations that no alternative accepts
  std::int64_t ambiguous = 0;             ///< invocations with more than one alternative
  std::int64_t other_branch = 0;          ///< of the ambiguous: accepted only by an alternative that is not the reference's
  std::int64_t gave_up = 0;               ///< invocations with too many alternatives
  std::int64_t rearranged = 0;            ///< invocations that only a rearrangement accepts
  std::uint64_t rearranged_distance = 0;  ///< largest distance of their values from the formula as written [codes]
  std::int64_t beyond = 0;                ///< of the failing: with elements that are OutputJudgement::beyond; 0 if these are few
  /// Failing invocations that are accepted, and near the results of the profile's own rearrangements, if products of sums are multiplied
  /// out, which no compiler is known to do.
  std::int64_t expanded = 0;
  /// One in `stride` invocations was drawn for widths and shares (judge/sample.h): ambiguous, other_branch, gave_up, and those of the
  /// outputs. 1: all.
  std::int64_t stride = 1;
  double unbounded_margin = 0;  ///< as Sample::margin, for unbounded elements
  bool is_of_sample = false;    ///< so much of the sample fails that the rest was not judged: all counts are of the sample
  std::int64_t with_bits = 0;   ///< how many of some hundreds of invocations the fast tests (short_cuts.h) find inside under this rounding
  std::int64_t undecided = 0;   ///< not tested under this rounding of half stores, because the other one accepts them
  std::vector<OutputJudgement> outputs;
};

/// A location in a port's shader that a cause refers to.
struct ShaderLine {
  std::string file;
  int line = 0;
  std::string text;  ///< of the line, without surrounding blanks; "" if the program does not contain its source
  int until = 0;     ///< if a step is missing: it belongs after `line` and not after this line. Else 0
  friend bool operator==(const ShaderLine&, const ShaderLine&) = default;
};

/// A possible cause of a pass's failures.
struct Cause {
  std::string name, sentence;
  std::int64_t explained = 0;  ///< failing texels whose stored bits it reproduces
  std::int64_t of = 0;         ///< failing texels replayed
  std::int64_t inside = 0;     ///< failing texels that it comes near: within the usual width of the envelope
  bool of_records = false;     ///< counts ids of a list that are missing, extra or wrong, not texels
  bool is_likely = false;      ///< it explains nearly all of them; otherwise it is only possible
  /// Location in the port's shader, if that is available; the best line first.
  std::vector<ShaderLine> lines = {};
  bool repeats_first = false;  ///< its sentence stands in that of the likely first cause too, because both give the same values
  /// False for an entry that only has lines, because no cause was found. It stands alone.
  bool is_found() const { return of > 0; }
};
/// Causes of a pass's failures, and their location.
struct Explanation {
  std::vector<Cause> causes;  ///< best first; empty: unknown
  std::string where = "";     ///< "only channel y of wave": common property of the failures; "": none
  bool is_otherwise = false;  ///< of FailedRun::otherwise
};

/// What the pack's runs exercise of a pass text; independent of the port.
struct PassCoverage {
  int taken = 0, alternatives = 0;  ///< as Exercise (coverage.h) names them; 0: its outputs are only given
  /// Alternatives not taken and without a known reason: "shade.pass.h, shade_corrected: clamp 2, below".
  std::vector<std::string> never;
  std::map<std::string, std::string> reasons{};  ///< of the other alternatives not taken
  bool is_sampled = false;                       ///< from a sample of the invocations: another sample may take more
};

struct PassJudgement {
  std::string pass, formula;
  Status status = Status::untested;
  std::string reason;
  bool inputs_are_good = true;  ///< every pass that it depends on passed
  HalfMode half_mode = HalfMode::either;
  std::array<std::int64_t, 3> half_votes{};  ///< failing invocations under rne, rtz, either
  std::array<bool, 3> half_is_least{};       ///< true if half_votes is only a lower bound: not every invocation had to be tested
  bool half_mode_voted = false;
  /// It fails under each rounding, and nothing tells which one the port uses. Causes were sought under both; half_mode is the one with the
  /// better cause.
  bool half_mode_is_open = false;
  std::vector<CaseJudgement> cases;
  std::vector<Cause> causes;  ///< best first; empty: unknown. For a WARN only the likely one
  bool causes_sought = true;  ///< false: causes were not sought
  std::string null_port;      ///< a null port that passes, which makes the pass UNTESTED: "zeros"; "": none
  std::string where = "";     ///< Explanation::where
  PassCoverage coverage;
};

/// A file of the port that is missing or cannot be used.
struct FileFault {
  ExitCode code = ExitCode::port_files;
  std::string pass, id, output;  ///< of the case, and the buffer of the file
  std::string text;              ///< the file, what was expected and what was found
};

struct PortJudgement {
  std::string pack, port, profile, effect, variant, scene;
  std::string api, device, driver;
  std::string command;  ///< that reproduces this judgement
  Status status = Status::untested;
  std::string reason;
  std::string first_bad_pass;         ///< in the order of dataflow
  std::vector<PassJudgement> passes;  ///< in the order of execution
  std::vector<FileFault> files;       ///< in the order of execution; the cases that need them are not judged
  std::vector<std::string> notes;
  std::vector<std::string> stale;  ///< entries of the baseline that did not fail: each is a sentence, and fails the run
};

}  // namespace rainref::judge
